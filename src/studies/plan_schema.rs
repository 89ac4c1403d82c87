//! The JSON Schema of the file of a study, from the very types that it is read into, and what of a file does not fit it: keys that are not known,
//! keys that are missing, and values of another kind, all at once.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

use crate::design::document::Node;
use crate::problem::{Problem, nearest};

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

/// Keys of a file that are unknown or missing, and values of another kind.
pub fn misfits(schema: &Value, file: &Node) -> Vec<Problem> {
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

    fn node(&self, schema: &'a Value, node: &Node, path: &str, list: &mut Vec<Problem>) {
        let forms = self.forms(schema);
        match node {
            Node::Map(entries) => {
                let here = |name: &str| if path.is_empty() { name.to_string() } else { format!("{path}.{name}") };
                let with_keys = forms.iter().find_map(|form| Some((form, form["properties"].as_object()?)));
                let Some((form, known)) = with_keys else {
                    // One that takes any keys has none to miss.
                    let any = forms.iter().map(|form| &form["additionalProperties"]).find(|inner| inner.is_object());
                    for (name, value) in entries {
                        any.into_iter().for_each(|inner| self.node(inner, value, &here(name), list));
                    }
                    return;
                };
                for (name, value) in entries {
                    match known.get(name) {
                        Some(inner) => self.node(inner, value, &here(name), list),
                        None => {
                            let near = nearest(name, known.keys().map(String::as_str));
                            let all: Vec<&str> = known.keys().map(String::as_str).collect();
                            let problem = Problem::new(here(name), "an unknown key", all.join(", "));
                            list.push(with_hint(problem, near));
                        }
                    }
                }
                let required = form["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
                for name in required.filter(|name| !entries.iter().any(|(key, _)| key == name)) {
                    list.push(Problem::new(here(name), "nothing", "this key, which must be given"));
                }
            }
            Node::List(items) => {
                let Some(inner) = forms.iter().map(|form| &form["items"]).find(|items| items.is_object()) else {
                    list.extend(of_another_kind(&forms, node, path));
                    return;
                };
                for (place, item) in items.iter().enumerate() {
                    self.node(inner, item, &format!("{path}.{place}"), list);
                }
            }
            Node::Text(_) | Node::Number(_) | Node::Flag(_) | Node::Nothing => {
                list.extend(of_another_kind(&forms, node, path));
            }
        }
    }
}

/// What the forms allow, where a value has none of them.
fn of_another_kind(forms: &[&Value], node: &Node, path: &str) -> Option<Problem> {
    if forms.iter().any(|form| fits(form, node)) {
        return None;
    }
    let words: Vec<&str> = forms.iter().flat_map(|form| choices(form)).collect();
    if words.is_empty() {
        let kinds = forms.iter().flat_map(|form| types(form)).filter(|kind| *kind != "null").map(in_words);
        let mut kinds: Vec<&str> = kinds.collect();
        kinds.dedup();
        return Some(Problem::new(path, node.describe(), kinds.join(" or ")));
    }
    let near = match node {
        Node::Text(text) => nearest(text, words.iter().copied()),
        _ => None,
    };
    Some(with_hint(Problem::new(path, node.describe(), words.join(", ")), near))
}

fn with_hint(problem: Problem, near: Option<&str>) -> Problem {
    match near {
        Some(near) => problem.hint(format!("did you mean `{near}`?")),
        None => problem,
    }
}

/// The words that a form allows, if it allows some only.
fn choices(form: &Value) -> Vec<&str> {
    let listed = form["enum"].as_array().into_iter().flatten();
    listed.chain([&form["const"]]).filter_map(Value::as_str).collect()
}

/// The kinds of values that a form allows, as the schema names them; none where it allows any.
fn types(form: &Value) -> Vec<&str> {
    match &form["type"] {
        Value::Array(several) => several.iter().filter_map(Value::as_str).collect(),
        one => one.as_str().into_iter().collect(),
    }
}

fn in_words(kind: &str) -> &str {
    match kind {
        "integer" => "a whole number",
        "number" => "a number",
        "string" => "a text",
        "boolean" => "true or false",
        "array" => "a list",
        "object" => "a group of keys",
        other => other,
    }
}

fn fits(form: &Value, node: &Node) -> bool {
    let (types, choices) = (types(form), choices(form));
    match node {
        Node::Text(text) if !choices.is_empty() => choices.contains(&text.as_str()),
        _ if !choices.is_empty() => false,
        _ if types.is_empty() => true,
        Node::Text(_) => types.contains(&"string"),
        Node::Number(number) => types.contains(&"number") || types.contains(&"integer") && number.fract() == 0.0,
        Node::Flag(_) => types.contains(&"boolean"),
        Node::Nothing => types.contains(&"null"),
        Node::List(_) => types.contains(&"array"),
        Node::Map(_) => types.contains(&"object"),
    }
}

#[cfg(test)]
mod tests {
    use crate::studies::plan::Study;

    #[test]
    fn all_wrong_keys_are_told_at_once_with_their_lines() {
        let text = "kind: size\nnam: x\ndesign: a.yaml\nchoises: []\nby: magic\npackings: few\nchoices:\n  - {key: a, value: [1]}\n";
        let wrong = Study::read(text, &|_| false).unwrap_err();
        let told: Vec<String> = wrong
            .iter()
            .map(|wrong| {
                let line = wrong.position.map_or(0, |position| position.line);
                format!("{line} {}: {} ({})", wrong.path, wrong.found, wrong.hint.as_deref().unwrap_or_default())
            })
            .collect();
        let wanted = [
            "2 nam: an unknown key (did you mean `name`?)",
            "4 choises: an unknown key (did you mean `choices`?)",
            "5 by: `magic` ()",
            "6 packings: `few` ()",
            "8 choices.0.value: an unknown key (did you mean `values`?)",
            "1 name: nothing ()",
            "3 design: `a.yaml`, which is not there ()",
        ];
        assert_eq!(told, wanted, "{wrong:#?}");
        assert_eq!([&wrong[2].allowed, &wrong[3].allowed], ["simulation, equations", "a whole number"]);
    }
}
