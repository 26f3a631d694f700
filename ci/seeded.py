"""Common functions of ci/defects and ci/mutants: a copy of the repository with switches, and runs of suites in it."""

import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "tests/defects"
# File of the switches in the copy. All packages depend on its package.
SWITCHES = "crates/subject/src/seeded.rs"
THEORY = ["load", "order", "verdict", "bound", "conservation", "energy", "force", "stability"]
# Marks around the tables of a page.
BEGIN, END = "<!-- written by ci/{} -->", "<!-- end -->"


def fail(message):
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {message}")


def put(path, text):
    """Writes a file only if its text has changed, because cargo compares modification times."""
    if not path.is_file() or path.read_bytes() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)


def write_copy(copy, changed, most):
    """Copies the repository, with the `changed` texts of files, `most` switches and the program that runs a suite."""
    listed = subprocess.check_output(
        ["git", "ls-files", "-co", "--exclude-standard", "--", "."], cwd=ROOT, text=True)
    files = [file for file in listed.splitlines() if (ROOT / file).is_file()]
    for old in [path for path in copy.rglob("*") if path.is_file()]:
        if str(old.relative_to(copy)) not in files + [SWITCHES]:
            old.unlink()
    for file in files:
        text = changed[file].encode() if file in changed else (ROOT / file).read_bytes()
        if file == "crates/subject/src/lib.rs":
            switches = b"extern crate self as mpm_subject;\n#[doc(hidden)]\npub mod seeded;\nmod column;"
            text = text.replace(b"mod column;", switches, 1)
        elif file == "Cargo.toml":
            text += b'\n[[bin]]\nname = "defects"\npath = "tests/defects/driver.rs"\n'
        put(copy / file, text)
    switches = (FOLDER / "seeded.rs").read_text().replace("MOST: usize = 1000", f"MOST: usize = {most + 1}")
    put(copy / SWITCHES, switches.encode())


def cargo(optimisation):
    return {"RUSTFLAGS": "-Awarnings", "CARGO_PROFILE_DEV_OPT_LEVEL": optimisation}


def digest(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def suite_names():
    """Returns the suites that the built-in solvers run. A suite for external solvers only has no snapshot."""
    files = (ROOT / "verification").glob("*/*.yaml")
    return sorted(path.stem for path in files if path.with_suffix(".snap").is_file())


def suite_file(suite, root):
    found, = (root / "verification").glob(f"*/{suite}.yaml")
    return found


def run(copy, binary, suite, number, limit, reached=None):
    """Runs `suite` with a defect. Returns the failing gates (gate -> first line) and the time on one core (s)."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "SEEDED": str(number)}
    if reached:
        environment["SEEDED_REACHED"] = str(reached)
    file = suite_file(suite, copy)
    command = [str(binary), str(file), str(file.parent)]
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        child = subprocess.Popen(command, cwd=copy, env=environment, stdout=out, stderr=err)
        end, done = time.time() + limit, 0
        while not done:
            time.sleep(0.005)
            done, status, usage = os.wait4(child.pid, os.WNOHANG)
            if not done and time.time() > end:
                child.kill()
                done, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        output, errors = out.read(), err.read()
    gates, seconds = {}, usage.ru_utime + usage.ru_stime
    if child.returncode == -signal.SIGKILL:
        gates["time"] = f"not done after {limit:.0f} s"
    elif child.returncode:
        lines = (errors.strip() or f"signal {-child.returncode}").splitlines()
        gates["panic"] = " ".join(lines[:2])[:200]
    else:
        found = json.loads(output)
        if found["load"]:
            gates["load"] = found["load"].splitlines()[0]
        for case, gate, line in found["cases"]:
            gates.setdefault(gate, f"{case}: {line}")
        if found["drift"]:
            gates["drift"] = "the report differs from its snapshot"
    return {"gates": gates, "seconds": seconds}


def theory(found):
    return [gate for gate in THEORY if gate in found["gates"]]


class Kept:
    """Results that are stored on disk."""

    def __init__(self, path):
        self.path = path
        self.kept = json.loads(path.read_text()) if path.is_file() else {}
        self.written, self.lock = time.time(), threading.Lock()

    def keep(self, key, value):
        with self.lock:
            self.kept[key] = value
            if time.time() - self.written > 10:
                self.write()

    def write(self):
        scratch = self.path.with_suffix(".new")
        scratch.write_text(json.dumps(self.kept))
        scratch.replace(self.path)
        self.written = time.time()


def baseline(suites, results, key, once, pool, work):
    """Runs every suite without a defect. Checks that it passes, and returns the switches that it reaches."""
    def one(suite):
        name = f"reached {key(suite)}"
        if name not in results.kept:
            reached = work / f"reached/{suite}"
            reached.parent.mkdir(exist_ok=True)
            reached.write_text("")
            found = once(suite, 0, 600, reached)
            found["reached"] = sorted(map(int, reached.read_text().split()))
            results.keep(name, found)
        return results.kept[name]

    base = dict(zip(suites, pool.map(one, suites)))
    if moved := [f"{suite}: {found['gates']}" for suite, found in base.items() if found["gates"]]:
        results.write()
        fail("\n".join(["without any defect not as kept:", *moved]))
    return base


def write_page(page, text):
    """Writes the tables between the marks of a page."""
    begin = BEGIN.format(pathlib.Path(sys.argv[0]).name)
    head, mark, rest = page.read_text().partition(begin)
    if not mark:
        fail(f"{page} does not have `{begin}`")
    page.write_text(f"{head}{begin}\n{text}{END}{rest.partition(END)[2]}")
