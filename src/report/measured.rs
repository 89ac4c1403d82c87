//! The quantities of a run as fields of `result.json`, by the list of [`crate::quantities`].

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

use crate::quantities::QUANTITIES;
use crate::quantities::observed::Observed;
use crate::quantities::quantity::{Json, Of, Quantity};

/// What a run showed, quantity by quantity.
#[derive(Debug)]
pub struct Measured(Vec<(&'static Quantity, Vec<f64>)>);

impl Measured {
    pub fn of(seen: &Observed) -> Self {
        Self(QUANTITIES.iter().map(|quantity| (*quantity, seen.each(quantity).to_vec())).collect())
    }
}

/// The name of the field, or of the group, that a quantity is in.
fn field(quantity: &Quantity) -> Option<&'static str> {
    match quantity.json {
        Json::Nowhere => None,
        Json::Key(name) | Json::In(name, _) => Some(name),
    }
}

/// Names of all fields in their order, each with the quantities in it.
fn fields() -> Vec<(&'static str, Vec<&'static Quantity>)> {
    let mut fields: Vec<(&str, Vec<&Quantity>)> = Vec::new();
    for quantity in QUANTITIES {
        let Some(name) = field(quantity) else { continue };
        match fields.iter_mut().find(|(known, _)| *known == name) {
            Some((_, quantities)) => quantities.push(quantity),
            None => fields.push((name, vec![quantity])),
        }
    }
    fields
}

/// A list of ropes or segments, or the number of a run; null where it tells none, and where a number is not finite.
fn value(quantity: &Quantity, values: &[f64]) -> Value {
    match quantity.of {
        Of::EachRope | Of::EachSegment | Of::EachPost | Of::EachAnchor => json!(values),
        Of::Run | Of::RunIfKnown => values.first().map_or(Value::Null, |value| json!(value)),
    }
}

/// Fields of a group in their order.
struct InOrder(Vec<(&'static str, Value)>);

impl Serialize for InOrder {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

impl Serialize for Measured {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let values = |quantity: &Quantity| {
            let known = self.0.iter().find(|(known, _)| known.id == quantity.id);
            known.map_or(&[][..], |(_, values)| values)
        };
        let mut map = serializer.serialize_map(None)?;
        for (name, quantities) in fields() {
            let segments = |quantity: &&&Quantity| quantity.of == Of::EachSegment && !values(quantity).is_empty();
            let of_walls = quantities.iter().any(|quantity| quantity.of == Of::EachSegment);
            let group = |quantity: &&Quantity| match quantity.json {
                Json::In(_, key) => Some((key, value(quantity, values(quantity)))),
                _ => None,
            };
            match quantities[0].json {
                // A net has no segments, and so nothing of a wall.
                Json::In(..) if of_walls && !quantities.iter().any(|quantity| segments(&quantity)) => {
                    map.serialize_entry(name, &Value::Null)?;
                }
                Json::In(..) => {
                    map.serialize_entry(name, &InOrder(quantities.iter().filter_map(group).collect()))?;
                }
                _ => map.serialize_entry(name, &value(quantities[0], values(quantities[0])))?,
            }
        }
        map.end()
    }
}

/// The schema of a quantity's field.
fn schema_of(quantity: &Quantity) -> Value {
    let mut schema = match quantity.of {
        Of::EachRope | Of::EachSegment | Of::EachPost | Of::EachAnchor => {
            json!({ "type": "array", "items": { "type": "number" } })
        }
        Of::Run | Of::RunIfKnown => json!({ "type": ["number", "null"] }),
    };
    if !quantity.meaning.is_empty() {
        schema["description"] = json!(quantity.meaning);
    }
    schema
}

impl JsonSchema for Measured {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Measured".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let mut properties = Map::new();
        let mut required = Vec::new();
        for (name, quantities) in fields() {
            let schema = match quantities[0].json {
                Json::In(..) => {
                    let keyed = |quantity: &&Quantity| match quantity.json {
                        Json::In(_, key) => Some((key.to_string(), schema_of(quantity))),
                        _ => None,
                    };
                    let inner: Map<String, Value> = quantities.iter().filter_map(keyed).collect();
                    let keys: Vec<&String> = inner.keys().collect();
                    json!({ "type": ["object", "null"], "required": keys, "properties": inner })
                }
                _ => schema_of(quantities[0]),
            };
            properties.insert(name.to_string(), schema);
            required.push(name);
        }
        let schema = json!({ "type": "object", "properties": properties, "required": required });
        Schema::try_from(schema).unwrap_or_default()
    }
}
