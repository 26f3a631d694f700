//! Gates that fail because of a change, each with the cause.

/// Runs that a change affects, with the cause.
struct Known {
    /// Beginning of the name of the run, `suite::case`.
    run: &'static str,
    /// Beginning of the name of the change; empty for all changes.
    change: &'static str,
    cause: &'static str,
}

const LIGHT_NODES: &str = "linear functions under USL amplify rounding where a particle has just come \
    to a node, and how near it comes depends on the arrangement (tiny-nodal-mass)";
const RIM: &str = "an error at the rim of a body is claimed, by its size or an order between two; \
    where the rim lies in its cells makes it";
const NO_ORDER: &str = "the claim is that there is no order, and which verdict says so hangs on few \
    crossings";

const KNOWN: [Known; 14] = [
    Known { run: "falling-block::mpm-linear-flip-usl", change: "axes", cause: LIGHT_NODES },
    Known { run: "falling-block::mpm-linear-flip-usl", change: "the grid", cause: LIGHT_NODES },
    Known { run: "expanding-ring", change: "the grid", cause: RIM },
    Known { run: "generalized-vortex", change: "the grid", cause: RIM },
    Known { run: "rotating-disk::mpm-linear-pic", change: "the grid", cause: RIM },
    Known { run: "spinning-disk::mpm-cpgimp-apic", change: "", cause: RIM },
    Known { run: "moving-bar-pulse::mpm-linear", change: "", cause: NO_ORDER },
    Known { run: "mms-axis-aligned-2d::mpm-linear", change: "", cause: NO_ORDER },
    Known { run: "mms-fixed-bar-large-fine::mpm-linear", change: "", cause: NO_ORDER },
    Known { run: "finite-strain-crossing::mpm-linear", change: "", cause: NO_ORDER },
    Known {
        run: "plastic-bar",
        change: "",
        cause: "its ten instants take whole steps, and other steps are no longer in proportion to h",
    },
    Known { run: "oedometer::mpm-linear-flip-usl", change: "", cause: NO_ORDER },
    Known {
        run: "local-damping-bar",
        change: "",
        cause: "damping turns where velocities do, and steps of the suite end there",
    },
    Known {
        run: "mms-axis-aligned-2d-periodic::mpm-cubic",
        change: "",
        cause: "an interval of 0.06 for an order that moves by 0.02",
    },
];

/// Returns the cause why the gates of a run fail under a change, if it is known.
pub(super) fn cause(run: &str, change: &str) -> Option<&'static str> {
    let fits = |known: &&Known| run.starts_with(known.run) && change.starts_with(known.change);
    KNOWN.iter().find(fits).map(|known| known.cause)
}
