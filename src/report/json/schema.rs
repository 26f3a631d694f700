//! JSON Schema (draft 2020-12) of the document that `run --format json` prints. Rows take their
//! keys and descriptions from the table columns. Tests check the other keys against documents.

use crate::report::columns::{TableColumn, cost, force, gradient, level, spectrum, stability};
use crate::verify::{
    Axis, CaseResult, FloorCause, GradientState, Quantity, Ranking, StabilityStudy, UnmetCode,
    Verdict,
};
use serde_json::{Map, Value, json};

/// Returns the schema as indented JSON.
pub fn report_schema() -> String {
    let suite = object([
        ("suite", text(), "name of the suite"),
        ("group", text(), "name of the folder of its file"),
        ("title", text(), "headline"),
        ("source", text(), "where the problem comes from"),
        ("problem", text(), "fingerprint of the statement, in hexadecimal digits"),
        ("statement", list(list(text())), "the problem, as rows of name and value"),
        ("passed", flag(), "whether every case had the expected result"),
        ("cases", list(case()), "cases, in the order of the suite"),
        ("cost", list(ranking()), "methods ranked by work, for each problem"),
    ]);
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "mpm-verify report",
        "description": format!("What version {} prints.", env!("CARGO_PKG_VERSION")),
        "$defs": {
            "number": {"anyOf": [{"type": "number"}, {"enum": ["nan", "inf", "-inf"]}]},
            "suite": suite,
        },
        "type": "object",
        "properties": {
            "version": {"type": "string", "description": "version of mpm-verify"},
            "commit": {
                "type": ["string", "null"],
                "description": "tested commit, if a CI service or git provides it",
            },
            "suites": list(json!({"$ref": "#/$defs/suite"})),
        },
        "required": ["version", "commit", "suites"],
        "additionalProperties": false,
    });
    format!("{schema:#}\n")
}

fn case() -> Value {
    let levels = row(&level::json_columns());
    let forces = row(&force::columns());
    let axes: Vec<&str> = Axis::ALL.iter().map(|axis| axis.name()).collect();
    // Verdicts of convergence studies. Other studies and inapplicable cases have others.
    let codes: Vec<_> = UnmetCode::ALL.iter().map(|code| code.name()).collect();
    let results: Vec<_> = CaseResult::ALL.iter().map(|result| result.name()).collect();
    let verdicts: Vec<_> = Verdict::ALL.iter().map(|verdict| verdict.name()).collect();
    let verdicts = json!({"anyOf": [{"enum": verdicts}, text()]});
    object([
        ("case", text(), "name of the case"),
        ("subject", text(), "the solver: `mpm`, `fem`, or an external program"),
        ("settings", list(list(text())), "method, as rows of name and value"),
        ("because", text(), "the reason of the expectation"),
        ("verdict", verdicts, "the verdict; suites write it with `_` for spaces and hyphens"),
        ("expected", or_null(text()), "the expectation; null if nothing is expected"),
        ("result", json!({"enum": results}), "short name of the result"),
        ("passed", flag(), "whether the case ran and had the expected result"),
        ("lacks", list(text()), "features that the case needs and its solver lacks"),
        ("reason", text(), "measured values that led to the verdict"),
        ("unmet", list(text()), "expectations that are not met"),
        ("codes", list(json!({"enum": codes})), "code of each unmet expectation"),
        ("profile", or_null(profile()), "cost of one step on the coarsest level"),
        ("axis", or_null(json!({"enum": axes})), "what is refined"),
        ("formal_order", or_null(number()), "theoretical order"),
        ("judge", or_null(judge()), "the judged error"),
        ("observed_order", or_null(interval()), "the order, with its 95 % interval"),
        ("floor", or_null(floor()), "the error on the finest level with another spacing halved"),
        ("levels", list(levels), "levels, from coarse to fine"),
        ("forces", or_null(list(forces)), "rows of an internal-force study"),
        ("stability", or_null(stability_study()), "rows of a stability study"),
        ("gradient", or_null(gradient_study()), "checks of a reported derivative"),
        ("spectrum", or_null(list(row(&spectrum::json_columns()))), "rows of a spectrum study"),
    ])
}

fn judge() -> Value {
    let quantities: Vec<&str> = Quantity::ALL.iter().map(|quantity| quantity.name()).collect();
    let within = object([
        ("from", list(number()), "lowest corner"),
        ("to", list(number()), "highest corner"),
    ]);
    object([
        ("of", json!({"enum": quantities}), "the judged quantity"),
        ("norm", text(), "norm of the error"),
        ("scale", or_null(number()), "divisor of the error"),
        ("within", or_null(within), "box of reference positions that errors are restricted to"),
    ])
}

fn profile() -> Value {
    let visit = object([
        ("part", text(), "part of a pass"),
        ("particles", whole(), "particles that it visits"),
    ]);
    let column = object([
        ("name", text(), "name of the column"),
        ("of", json!({"enum": ["particle", "node"]}), "owner of an entry"),
        ("entries", whole(), "number of entries"),
        ("bytes", whole(), "bytes of an entry"),
    ]);
    object([
        ("effects", list(text()), "active effects"),
        ("particles", whole(), "particles"),
        ("nodes", whole(), "nodes of the grid"),
        ("passes", list(text()), "passes of a step, in their order"),
        ("visits", list(visit), "particles that each part of a pass visits"),
        ("columns", list(column), "memory"),
    ])
}

fn floor() -> Value {
    let causes: Vec<&str> = FloorCause::ALL.iter().map(|cause| cause.name()).collect();
    let probe = object([
        ("axis", text(), "spacing that is halved"),
        ("error", or_null(number()), "error on the finest level with this spacing halved"),
        ("failure", or_null(text()), "reason why this error is missing"),
    ]);
    object([
        ("cause", or_null(json!({"enum": causes})), "axis that causes the floor"),
        ("error", number(), "error on the finest level"),
        ("probes", list(probe), "runs with one spacing halved"),
    ])
}

fn interval() -> Value {
    object([
        ("value", number(), "the estimate"),
        ("low", number(), "lower end"),
        ("high", number(), "upper end"),
    ])
}

fn stability_study() -> Value {
    let (figures, rows) = (Vec::new(), Vec::new());
    let study = StabilityStudy { swept: String::new(), sought: None, figures, rows };
    object([
        ("swept", text(), "parameter whose values make the rows"),
        ("sought", or_null(text()), "parameter whose limit is sought"),
        ("rows", list(row(&stability::json_columns(&study))), "one for each value"),
    ])
}

fn gradient_study() -> Value {
    let states: Vec<&str> = GradientState::ALL.iter().map(|state| state.name()).collect();
    let sweep = object([
        ("change", number(), "change of the functional over the interval"),
        ("share", number(), "trapezoidal sum of the derivative, divided by the change"),
        ("jumps", list(number()), "jumps of the functional, divided by the change"),
    ]);
    object([
        ("functional", text(), "the functional that is differentiated"),
        ("parameter", text(), "the parameter of the problem"),
        ("state", json!({"enum": states}), "the state of the derivative"),
        ("value", number(), "value of the functional after a run without derivatives"),
        ("reported_value", number(), "value that the solver reports with the gradient"),
        ("order", number(), "order of the error of the derivative"),
        ("levels", list(row(&gradient::levels())), "the derivative on all levels"),
        ("taylor", list(row(&gradient::taylor())), "the Taylor remainder"),
        ("sweep", or_null(sweep), "the derivative over an interval of the parameter"),
        ("points", list(row(&gradient::points())), "points of the sweep"),
    ])
}

fn ranking() -> Value {
    let methods = row(&cost::json_columns(&Ranking::new(String::new(), 1.0, &[], Vec::new())));
    object([
        ("problem", text(), "end of the run, and the solution that errors refer to"),
        ("size", number(), "divisor of errors"),
        ("work", text(), "unit of the work"),
        ("targets", list(number()), "errors whose work is compared"),
        ("methods", list(methods), "the cheapest first"),
    ])
}

/// Returns the schema of a table row; `errors.rms` is the key `rms` of the object `errors`.
fn row<R>(columns: &[TableColumn<'_, R>]) -> Value {
    let mut properties = Map::new();
    for column in columns.iter().filter(|column| !column.key.is_empty()) {
        let about = json!({"description": column.about});
        match column.key.split_once('.') {
            None => _ = properties.insert(column.key.to_owned(), about),
            Some((outer, inner)) => {
                let nested = properties
                    .entry(outer)
                    .or_insert_with(|| json!({"type": ["object", "null"], "properties": {}}));
                nested["properties"][inner] = about;
            }
        }
    }
    closed(properties)
}

fn object<const N: usize>(keys: [(&str, Value, &str); N]) -> Value {
    let property = |(key, mut schema, about): (&str, Value, &str)| {
        schema["description"] = about.into();
        (key.to_owned(), schema)
    };
    closed(keys.into_iter().map(property).collect())
}

/// Returns the schema of an object with all of these keys and no others.
fn closed(properties: Map<String, Value>) -> Value {
    let keys: Vec<&String> = properties.keys().collect();
    let object = json!({"type": "object", "required": keys, "additionalProperties": false});
    with(object, "properties", properties.into())
}

fn list(items: Value) -> Value {
    with(json!({"type": "array"}), "items", items)
}

fn or_null(schema: Value) -> Value {
    with(json!({}), "anyOf", vec![schema, json!({"type": "null"})].into())
}

fn with(mut schema: Value, keyword: &str, value: Value) -> Value {
    schema[keyword] = value;
    schema
}

fn number() -> Value {
    json!({"$ref": "#/$defs/number"})
}

fn text() -> Value {
    json!({"type": "string"})
}

fn whole() -> Value {
    json!({"type": "integer", "minimum": 0})
}

fn flag() -> Value {
    json!({"type": "boolean"})
}
