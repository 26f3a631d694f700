"""Messages of the solver protocol against its JSON Schema.

Arguments: the schema, the document with its examples, and a folder of transcripts, `*.request` and
`*.answer`. Every message must be of its side, every example of one of the two, and each of the
messages below of neither.
"""

import json
import pathlib
import re
import sys

import jsonschema

# Messages that are valid except for one mistake in their structure.
WRONG = [
    {},
    {"type": "helo", "protocol": 1, "name": "a"},
    {"type": "hello", "name": "a"},
    {"type": "hello", "protocol": "1", "name": "a"},
    {"type": "hello", "protocol": 1, "name": "a", "precision": "half"},
    {"type": "hello", "protocol": 1, "name": "a", "capabilities": {"dimensions": 2}},
    {"type": "hello", "protocol": 1, "name": "a", "capabilities": {"laws": [1]}},
    {"type": "ready", "points": {"reference_position": [0]}},
    {"type": "cannot"},
    {"type": "failed", "reason": 3},
    {"type": "state"},
    {"type": "state", "columns": {"displacement": ["0"]}},
    {"type": "state", "columns": {"displacement": {"f64": [0]}}},
    {"type": "state", "columns": {"displacement": [0]}, "bytes": -8},
    {"type": "state", "columns": {"displacement": [0]}, "crossings": 0.5},
    {"type": "body_force"},
    {"type": "body_force", "t": "0"},
    {"type": "values"},
    {"type": "values", "of": 3},
    {"type": "values", "of": "velocity", "t": "0"},
    {"type": "values", "of": "velocity", "body": -1},
    {"type": "advance", "steps": -1, "dt": 0.1, "from": 0},
    {"type": "problem", "suite": "a"},
]


def messages(path):
    """Returns the messages of a transcript, without the blocks of bytes that follow some messages."""
    with open(path, "rb") as file:
        while line := file.readline():
            message = json.loads(line)
            file.read(message.get("bytes", 0))
            yield message


def main(schema_path, document, transcripts):
    with open(schema_path, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft202012Validator.check_schema(schema)

    def of(side):
        return jsonschema.Draft202012Validator({**schema, "anyOf": [{"$ref": f"#/$defs/{side}"}]})

    count = 0
    for path in sorted(pathlib.Path(transcripts).iterdir()):
        side = of(path.suffix.removeprefix("."))
        for message in messages(path):
            side.validate(message)
            count += 1
    either = jsonschema.Draft202012Validator(schema)
    with open(document, encoding="utf-8") as file:
        examples = re.findall(r"^```json\n(.*?)```", file.read(), re.M | re.S)
    for example in examples:
        either.validate(json.loads(example))
    passed = [message for message in WRONG if either.is_valid(message)]
    if passed or not examples or count < 10:
        sys.exit(f"the schema lets pass {passed}; {len(examples)} examples, {count} messages")
    print(f"schema: {count} messages, {len(examples)} examples, {len(WRONG)} wrong ones refused")


main(*sys.argv[1:])
