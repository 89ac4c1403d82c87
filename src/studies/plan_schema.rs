//! The JSON Schema of the file of a study, from the very types that it is read into, and what of a file does not fit it: keys that are not known, and
//! keys that are missing, all at once.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

use crate::design::document::Node;
use crate::problem::nearest;

/// Schema of the file of a study of a kind, whose keys beside `kind` are those of `T`.
pub fn of_kind<T: JsonSchema>(kind: &str) -> Value {
    let mut schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<T>().to_value();
    schema["properties"]["kind"] = json!({ "const": kind });
    if let Some(required) = schema["required"].as_array_mut() {
        required.insert(0, json!("kind"));
    }
    schema
}

/// Schema of a file that fits one of several, whose definitions go together.
pub fn one_of(schemas: impl IntoIterator<Item = Value>) -> Value {
    let (mut kinds, mut definitions) = (Vec::new(), Map::new());
    for mut schema in schemas {
        if let Some(kind) = schema.as_object_mut() {
            kind.remove("$schema");
            if let Some(Value::Object(own)) = kind.remove("definitions") {
                definitions.extend(own);
            }
        }
        kinds.push(schema);
    }
    json!({ "$schema": "http://json-schema.org/draft-07/schema#", "title": "barrier-check study", "oneOf": kinds, "definitions": definitions })
}

/// Keys of a file that are unknown or missing: the path, and what is wrong there.
pub fn misfits(schema: &Value, file: &Node) -> Vec<[String; 2]> {
    let mut list = Vec::new();
    Walk { whole: schema }.node(schema, file, "", &mut list);
    list
}

struct Walk<'a> {
    whole: &'a Value,
}

impl<'a> Walk<'a> {
    /// The forms that a value may have, with what they refer to.
    fn forms(&self, schema: &'a Value) -> Vec<&'a Value> {
        if let Some(name) = schema["$ref"].as_str() {
            let target = name.trim_start_matches("#/").split('/').fold(self.whole, |at, part| &at[part]);
            return self.forms(target);
        }
        let several = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|key| schema[key].as_array()).flatten();
        let inner: Vec<&Value> = several.flat_map(|form| self.forms(form)).collect();
        if inner.is_empty() { vec![schema] } else { inner }
    }

    fn node(&self, schema: &'a Value, node: &Node, path: &str, list: &mut Vec<[String; 2]>) {
        let forms = self.forms(schema);
        match node {
            Node::Map(entries) => {
                // One that takes any keys has none to miss.
                let Some(form) = forms.iter().find(|form| form["properties"].is_object()) else { return };
                let Some(known) = form["properties"].as_object() else { return };
                let here = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
                for (name, value) in entries {
                    match known.get(name) {
                        Some(inner) => self.node(inner, value, &here(name), list),
                        None => {
                            let near = nearest(name, known.keys().map(String::as_str));
                            let near = near.map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
                            let all: Vec<&str> = known.keys().map(String::as_str).collect();
                            list.push([here(name), format!("unknown key, allowed {}{near}", all.join(", "))]);
                        }
                    }
                }
                let required = form["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
                for name in required.filter(|name| !entries.iter().any(|(key, _)| key == name)) {
                    list.push([here(name), "missing key".to_string()]);
                }
            }
            Node::List(items) => {
                let Some(inner) = forms.iter().map(|form| &form["items"]).find(|items| items.is_object()) else {
                    return;
                };
                for (place, item) in items.iter().enumerate() {
                    self.node(inner, item, &format!("{path}.{place}"), list);
                }
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::studies::plan::Study;

    #[test]
    fn all_wrong_keys_are_told_at_once_with_their_lines() {
        let text = "kind: size\nnam: x\ndesign: a.yaml\nchoises: []\nchoices:\n  - {key: a, value: [1]}\n";
        let wrong = Study::read(text).unwrap_err();
        let told: Vec<&str> = wrong.iter().map(|wrong| wrong.split(" key").next().unwrap_or_default()).collect();
        let wanted = [
            "line 2, nam: unknown",
            "line 4, choises: unknown",
            "line 6, choices.0.value: unknown",
            "line 1, name: missing",
        ];
        assert_eq!(told, wanted, "{wrong:#?}");
        let near = ["`name`", "`choices`", "`values`"];
        assert!(wrong.iter().zip(near).all(|(wrong, near)| wrong.ends_with(&format!("(did you mean {near}?)"))));
    }
}
