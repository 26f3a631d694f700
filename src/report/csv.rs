//! Reports as a table of comma-separated values, for spreadsheets and plots.

use crate::report::columns::level;
use crate::report::suite::json;
use crate::verify::SuiteOutcome;
use serde_json::Value;
use std::collections::HashMap;

/// Case keys of the JSON document whose values are repeated in each row of the case.
const OF_CASE: [&str; 9] = [
    "case",
    "subject",
    "result",
    "verdict",
    "axis",
    "formal_order",
    "observed_order",
    "judge",
    "expected",
];

type CsvRow = HashMap<String, String>;

/// Converts reports to CSV, with one row for each level, each value of a stability study and each
/// position of an internal-force study, or one row for a case without any of these.
///
/// Column names are the keys of the JSON document ([`json`](crate::report::json())), with a dot
/// between outer and inner key (`errors.rms`, `observed_order.low`). Columns of stability and
/// internal-force studies begin with `stability.` and `forces.`. Numbers have enough digits to be
/// read back exactly. A field is empty if the document contains `null`.
///
/// # Panics
/// Never, because writing to memory does not fail.
pub fn csv(outcomes: &[SuiteOutcome]) -> String {
    let mut table = CsvTable::default();
    for outcome in outcomes {
        for case in &outcome.cases {
            table.add_case(&outcome.suite, &json::case(case));
        }
    }
    table.text()
}

#[derive(Default)]
struct CsvTable {
    /// Column names in order of first occurrence.
    columns: Vec<String>,
    rows: Vec<CsvRow>,
}

impl CsvTable {
    fn add_case(&mut self, suite: &str, case: &Value) {
        let mut shared = CsvRow::new();
        self.put(&mut shared, "suite", &suite.into());
        for key in OF_CASE {
            self.put(&mut shared, key, &case[key]);
        }
        let lists = [
            ("", &case["levels"], level_keys()),
            ("stability.", &case["stability"]["rows"], Vec::new()),
            ("forces.", &case["forces"], Vec::new()),
        ];
        let before = self.rows.len();
        for (prefix, list, order) in lists {
            for members in list.as_array().into_iter().flatten().filter_map(Value::as_object) {
                let mut row = shared.clone();
                let declared = order.iter().filter_map(|key| members.get_key_value(*key));
                let others = members.iter().filter(|(key, _)| !order.contains(&key.as_str()));
                for (key, value) in declared.chain(others) {
                    self.put(&mut row, &format!("{prefix}{key}"), value);
                }
                self.rows.push(row);
            }
        }
        if self.rows.len() == before {
            self.rows.push(shared);
        }
    }

    fn put(&mut self, row: &mut CsvRow, column: &str, value: &Value) {
        let text = match value {
            Value::Null => return,
            Value::Object(members) => {
                for (key, value) in members {
                    self.put(row, &format!("{column}.{key}"), value);
                }
                return;
            }
            Value::Array(items) => {
                for (index, value) in items.iter().enumerate() {
                    self.put(row, &format!("{column}.{index}"), value);
                }
                return;
            }
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        if !self.columns.iter().any(|known| known == column) {
            self.columns.push(column.to_owned());
        }
        row.insert(column.to_owned(), text);
    }

    fn text(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write = |record: &mut dyn Iterator<Item = &str>| {
            writer.write_record(record).expect("memory is written to, rows have equal lengths");
        };
        write(&mut self.columns.iter().map(String::as_str));
        for row in &self.rows {
            let field = |column: &String| row.get(column).map_or("", String::as_str);
            write(&mut self.columns.iter().map(field));
        }
        let bytes = writer.into_inner().expect("memory is written to");
        String::from_utf8(bytes).expect("fields are UTF-8")
    }
}

fn level_keys() -> Vec<&'static str> {
    let outer = |key: &'static str| key.split_once('.').map_or(key, |(outer, _)| outer);
    let mut keys: Vec<_> = level::json_columns().iter().map(|column| outer(column.key)).collect();
    keys.dedup();
    keys
}
