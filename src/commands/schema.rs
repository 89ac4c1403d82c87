//! `barrier-check schema`: JSON Schemas of the design file and of `result.json`.

use serde_json::{Map, Value, json};

use crate::design::key::{Key, Kind, Need};
use crate::design::schema::DESIGN;
use crate::report::json::ResultFile;
use crate::units::Dimension;

/// Schema of `result.json`.
pub fn result_schema() -> Value {
    serde_json::to_value(schemars::schema_for!(ResultFile)).unwrap_or(Value::Null)
}

/// Schema of the design file, from the same tables that reading uses.
pub fn design_schema() -> Value {
    let mut schema = section(DESIGN);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("barrier-check design");
    schema
}

fn section(keys: &[Key]) -> Value {
    let required: Vec<&str> =
        keys.iter().filter(|key| matches!(key.need, Need::Required | Need::ForGrains)).map(|key| key.name).collect();
    json!({ "type": "object", "additionalProperties": false, "properties": properties(keys), "required": required })
}

fn properties(keys: &[Key]) -> Map<String, Value> {
    let entry = |key: &Key| {
        let mut schema = kind(&key.kind);
        schema["description"] = json!(key.meaning);
        if let (Need::Default(typed), false) = (key.need, matches!(key.kind, Kind::Section(_))) {
            schema["default"] = json!(typed);
        }
        (key.name.to_string(), schema)
    };
    keys.iter().map(entry).collect()
}

fn kind(kind: &Kind) -> Value {
    match *kind {
        Kind::Quantity { dimension, .. } => {
            let units = dimension.symbols().join("|");
            json!({ "type": "string", "pattern": format!("^[-+0-9.eE]+ ?({units})$") })
        }
        Kind::LengthOrGrains { .. } => {
            let units = Dimension::Length.symbols().join("|");
            json!({ "type": "string", "pattern": format!("^[-+0-9.eE]+ ?({units}|[Dd][1-9][0-9]?)$") })
        }
        Kind::Quantities { dimension, low, high } => {
            json!({ "type": "array", "minItems": 1, "items": self::kind(&Kind::Quantity { dimension, low, high }) })
        }
        Kind::Number { low, high } => json!({ "type": "number", "minimum": low, "maximum": high }),
        Kind::Count { low, high } => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Kind::Text => json!({ "type": ["string", "number"] }),
        Kind::Choice(words) => json!({ "enum": words }),
        Kind::Section(keys) => section(keys),
        Kind::OneOf(keys) => {
            let mut schema = section(keys);
            schema["minProperties"] = json!(1);
            schema["maxProperties"] = json!(1);
            schema
        }
    }
}
