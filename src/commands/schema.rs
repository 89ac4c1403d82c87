//! `barrier-check schema`: JSON Schemas of the design file and of what the program writes for other programs.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

use crate::commands::messages::MessagesFile;
use crate::design::key::{Key, Kind, Need};
use crate::design::schema::{DESIGN, EITHER, Either};
use crate::report::json::ResultFile;
use crate::report::probability_json::ReliabilityFile;
use crate::report::size::SizeFile;
use crate::report::sweep::SweepFile;
use crate::units::Dimension;

/// The draft that validators know without being told.
const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

/// What a schema is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum SchemaOf {
    /// A design file
    Design,
    /// A study file
    Study,
    /// result.json of a run
    Result,
    /// size.json of a study
    Size,
    /// reliability.json of a study
    Reliability,
    /// sweep.json of a study
    Sweep,
    /// What --format json prints
    Messages,
}

impl SchemaOf {
    pub fn schema(self) -> Value {
        match self {
            Self::Design => design_schema(),
            Self::Study => study_schema(),
            Self::Result => of_a_file::<ResultFile>(),
            Self::Size => of_a_file::<SizeFile>(),
            Self::Reliability => of_a_file::<ReliabilityFile>(),
            Self::Sweep => of_a_file::<SweepFile>(),
            Self::Messages => of_a_file::<MessagesFile>(),
        }
    }
}

/// Schema of a file that the program writes.
fn of_a_file<T: JsonSchema>() -> Value {
    let generator = SchemaSettings::draft07().into_generator();
    let mut schema = generator.into_root_schema_for::<T>().to_value();
    plain(&mut schema);
    schema
}

/// Schema of the file of a study, from the types that it is read into.
fn study_schema() -> Value {
    let mut schema = crate::studies::plan::schema();
    without_formats(&mut schema);
    schema
}

/// Leaves out formats that only some validators know.
fn without_formats(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            if map.get("format").is_some_and(Value::is_string) {
                map.remove("format");
            }
            map.values_mut().for_each(without_formats);
        }
        Value::Array(items) => items.iter_mut().for_each(without_formats),
        _ => {}
    }
}

/// The same, and lets every number be null: JSON has no infinity and no NaN.
fn plain(schema: &mut Value) {
    without_formats(schema);
    let_numbers_be_null(schema);
}

fn let_numbers_be_null(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            if map.get("type").is_some_and(|kind| kind == "number") {
                map.insert("type".into(), json!(["number", "null"]));
            }
            map.values_mut().for_each(let_numbers_be_null);
        }
        Value::Array(items) => items.iter_mut().for_each(let_numbers_be_null),
        _ => {}
    }
}

/// Schema of the design file, from the same tables that reading uses.
fn design_schema() -> Value {
    let mut schema = section(DESIGN);
    schema["$schema"] = json!(DRAFT);
    schema["title"] = json!("barrier-check design");
    schema
}

fn section(keys: &[Key]) -> Value {
    let required: Vec<&str> =
        keys.iter().filter(|key| matches!(key.need, Need::Required | Need::ForGrains)).map(|key| key.name).collect();
    let mut schema = json!({ "type": "object", "additionalProperties": false, "properties": properties(keys), "required": required });
    let has = |name: &str| keys.iter().any(|key| key.name == name);
    let here = |pair: &&Either| pair.keys.iter().all(|name| has(name)) && (pair.beside.is_empty() || has(pair.beside));
    for pair in EITHER.iter().filter(here) {
        if pair.needed {
            let mut one: Vec<Value> = pair.keys.iter().map(|key| json!({ "required": [key] })).collect();
            let group = |[group, key]: &[&str; 2]| json!({ "properties": { *group: { "required": [key] } }, "required": [group] });
            one.extend(pair.instead.iter().map(group));
            schema["oneOf"] = one.into();
        } else {
            schema["not"] = json!({ "required": pair.keys });
        }
    }
    schema
}

fn properties(keys: &[Key]) -> Map<String, Value> {
    let entry = |key: &Key| {
        let mut schema = kind(&key.kind);
        schema["description"] = json!(key.meaning);
        if let (Need::Default(typed), false) = (key.need, matches!(key.kind, Kind::Section(_))) {
            schema["default"] = match key.kind {
                Kind::Number { .. } | Kind::Count { .. } => serde_json::from_str(typed).unwrap_or(json!(typed)),
                _ => json!(typed),
            };
        }
        (key.name.to_string(), schema)
    };
    let former = |key: &Key| {
        let former = key.former?;
        let mut schema = kind(&key.kind);
        schema["description"] = json!(format!("former name of {}", key.name));
        Some((former.to_string(), schema))
    };
    keys.iter().map(entry).chain(keys.iter().filter_map(former)).collect()
}

/// A number as a pattern.
const NUMBER: &str = "[-+]?[0-9.]+([eE][-+]?[0-9]+)?";

/// The symbols of a dimension as a pattern, with what else stands for a power or for degrees.
fn units(dimension: Dimension) -> String {
    let spellings = |symbol: &str| symbol.replace('2', "(\\^?2|²)").replace('3', "(\\^?3|³)").replace("deg", "(deg|°)");
    dimension.symbols().into_iter().map(spellings).collect::<Vec<_>>().join("|")
}

fn kind(kind: &Kind) -> Value {
    match *kind {
        Kind::Quantity { dimension, .. } => {
            json!({ "type": "string", "pattern": format!("^ *{NUMBER} *({}) *$", units(dimension)) })
        }
        Kind::LengthOrGrains { .. } => {
            let length = units(Dimension::Length);
            json!({ "type": "string", "pattern": format!("^ *({NUMBER} *({length})|({NUMBER} *)?[Dd][1-9][0-9]?) *$") })
        }
        Kind::Quantities { dimension, low, high } => {
            json!({ "type": "array", "minItems": 1, "items": self::kind(&Kind::Quantity { dimension, low, high }) })
        }
        Kind::Pairs { first, second, .. } => {
            let both = [first, second].map(|value| self::kind(&value.kind()));
            json!({ "type": "array", "minItems": 1, "items": { "type": "array", "minItems": 2, "maxItems": 2, "items": both } })
        }
        Kind::Pair { first, second, .. } => {
            let both = [first, second].map(|value| self::kind(&value.kind()));
            json!({ "type": "array", "minItems": 2, "maxItems": 2, "items": both })
        }
        Kind::Steepness { .. } => {
            let angle = units(Dimension::Angle);
            json!({ "type": "string", "pattern": format!("^ *({NUMBER} *({angle})|[0-9.]+ *: *[0-9.]+) *$") })
        }
        Kind::Number { low, high } => json!({ "type": "number", "minimum": low, "maximum": high }),
        Kind::Count { low, high } => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Kind::Text => json!({ "type": ["string", "number", "boolean"] }),
        Kind::File => json!({ "type": "string", "minLength": 1 }),
        Kind::Choice(words) => json!({ "enum": words }),
        Kind::Section(keys) => section(keys),
        Kind::SectionOrNone(keys) => json!({ "anyOf": [{ "const": "none" }, section(keys)] }),
        Kind::Sections(keys) => json!({ "type": "array", "minItems": 1, "items": section(keys) }),
        Kind::OneOf(keys) => {
            let mut schema = section(keys);
            schema["minProperties"] = json!(1);
            schema["maxProperties"] = json!(1);
            // What a kit says need not be said beside it.
            match keys.iter().find(|key| key.name == "kit") {
                Some(key) => {
                    let mut with_kit = json!({ "type": "object", "required": ["kit"], "properties": { "kit": self::kind(&key.kind) } });
                    with_kit["properties"]["kit"]["description"] = json!(key.meaning);
                    json!({ "anyOf": [with_kit, schema] })
                }
                None => schema,
            }
        }
    }
}
