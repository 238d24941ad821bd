//! The schema of a type: what its TOML may hold, made from the type itself.

use super::schema::Node;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value;
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// How to get the schema of an entry's settings: a registry holds it in a static, before anyone asks.
#[derive(Clone, Copy)]
pub struct Accepted {
    inside: fn(&mut SchemaGenerator) -> Schema,
    with: fn(SchemaGenerator) -> Schema,
    whole: fn() -> Arc<Value>,
}

impl std::fmt::Debug for Accepted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Accepted")
    }
}

impl Accepted {
    /// The shape of `T`.
    pub const fn shape<T: JsonSchema + 'static>() -> Self {
        Self {
            inside: |generator| generator.subschema_for::<T>(),
            with: |generator| generator.into_root_schema_for::<T>(),
            whole: schema_of::<T>,
        }
    }

    /// The schema by itself, with the definitions that it refers to under `$defs`.
    pub fn schema(&self) -> Arc<Value> {
        (self.whole)()
    }

    /// The keys that have a meaning.
    pub fn keys(&self) -> Vec<String> {
        let schema = self.schema();
        Node::root(&schema).properties().map(|(key, _)| key.to_owned()).collect()
    }

    /// Whether `key` has a meaning.
    pub fn has(&self, key: &str) -> bool {
        Node::root(&self.schema()).property(key).is_some()
    }

    /// The schema by itself, with the definitions that `generator` has made besides its own.
    pub fn whole_with(&self, generator: SchemaGenerator) -> Value {
        (self.with)(generator).to_value()
    }

    /// The schema as a part of a larger one that `generator` makes.
    pub fn within(&self, generator: &mut SchemaGenerator) -> Value {
        (self.inside)(generator).to_value()
    }
}

/// The shape of settings that an entry has none of.
#[derive(Debug, Clone, Copy, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoSettings {}

/// What makes schemas: draft 2020-12.
pub fn generator() -> SchemaGenerator {
    SchemaSettings::draft2020_12().into_generator()
}

/// The schema of `T`, made once.
pub fn schema_of<T: JsonSchema + 'static>() -> Arc<Value> {
    made_once(TypeId::of::<T>(), SchemaGenerator::into_root_schema_for::<T>)
}

/// What is not compiled again for every type.
fn made_once(of: TypeId, make: fn(SchemaGenerator) -> Schema) -> Arc<Value> {
    static MADE: Mutex<BTreeMap<TypeId, Arc<Value>>> = Mutex::new(BTreeMap::new());
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    made.entry(of).or_insert_with(|| Arc::new(make(generator()).to_value())).clone()
}
