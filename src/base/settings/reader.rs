//! Reads parsed TOML into types, where it stands.
//!
//! What serde derives for a type is compiled once for each kind of deserializer, with much of the deserializer in it. This one
//! borrows what was parsed and has little in it, so that types that read settings take half of the code that they take with the
//! TOML library's own.

use super::validate::{number, whole};
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, Expected, IntoDeserializer, MapAccess,
    SeqAccess, Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;
use std::cell::Cell;
use std::fmt;
use std::ops::Range;
use toml::Spanned;
use toml::de::DeValue;

/// Why a value could not be read, and the bytes where it stands.
#[derive(Debug)]
pub(super) struct Refused {
    pub(super) message: String,
    pub(super) span: Option<Range<usize>>,
}

impl Refused {
    /// The innermost place counts.
    fn within(mut self, span: Range<usize>) -> Self {
        self.span.get_or_insert(span);
        self
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Refused {}

impl de::Error for Refused {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

/// `value` as a `T`.
pub(super) fn read<T: DeserializeOwned>(value: &Spanned<DeValue<'_>>) -> Result<T, Refused> {
    T::deserialize(Reader(value))
}

/// The name under which a value asks where it stands.
pub(super) const WITH_PLACE: &str = "$with_place";

thread_local! {
    static PLACE: Cell<Option<Range<usize>>> = const { Cell::new(None) };
}

/// Where the value stands that was requested under [`WITH_PLACE`] last: serde has no other way for it that is not compiled
/// again for every type.
pub(super) fn take_place() -> Range<usize> {
    PLACE.take().unwrap_or_default()
}

/// A value that is read.
#[derive(Clone, Copy)]
struct Reader<'a, 't>(&'a Spanned<DeValue<'t>>);

impl Reader<'_, '_> {
    /// That this is not what is expected.
    fn is_not(self, expected: &dyn Expected) -> Refused {
        let found = match self.0.get_ref() {
            DeValue::String(text) => Unexpected::Str(text),
            value @ DeValue::Integer(_) => match Whole::new(value) {
                Whole::Signed(whole) => Unexpected::Signed(whole),
                Whole::Unsigned(whole) => Unexpected::Unsigned(whole),
                Whole::None => return self.refused(TOO_FAR),
            },
            value @ DeValue::Float(_) => Unexpected::Float(number(value).unwrap_or(f64::NAN)),
            DeValue::Boolean(truth) => Unexpected::Bool(*truth),
            DeValue::Datetime(_) => return self.refused(NO_DATES),
            DeValue::Array(_) => Unexpected::Seq,
            DeValue::Table(_) => Unexpected::Map,
        };
        de::Error::invalid_type(found, expected)
    }

    fn refused(self, message: &str) -> Refused {
        Refused { message: message.to_owned(), span: Some(self.0.span()) }
    }
}

const TOO_FAR: &str = "no machine holds a whole number so far from zero";
const NO_DATES: &str = "a date or time is not accepted";

impl<'de> Deserializer<'de> for Reader<'_, '_> {
    type Error = Refused;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        match self.0.get_ref() {
            DeValue::String(text) => visitor.visit_str(text),
            value @ DeValue::Integer(_) => match Whole::new(value) {
                Whole::Signed(whole) => visitor.visit_i64(whole),
                Whole::Unsigned(whole) => visitor.visit_u64(whole),
                Whole::None => Err(self.refused(TOO_FAR)),
            },
            value @ DeValue::Float(_) => visitor.visit_f64(number(value).unwrap_or(f64::NAN)),
            DeValue::Boolean(truth) => visitor.visit_bool(*truth),
            DeValue::Datetime(_) => Err(self.refused(NO_DATES)),
            DeValue::Array(_) => return self.deserialize_seq(visitor),
            DeValue::Table(_) => return self.deserialize_map(visitor),
        }
        .map_err(|refused| refused.within(self.0.span()))
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        match self.0.get_ref() {
            DeValue::Array(elements) => visitor.visit_seq(Elements(elements.iter())),
            _ => Err(self.is_not(&visitor)),
        }
        .map_err(|refused| refused.within(self.0.span()))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        match self.0.get_ref() {
            DeValue::Table(table) => visitor.visit_map(Entries { entries: table.iter(), value: None }),
            _ => Err(self.is_not(&visitor)),
        }
        .map_err(|refused| refused.within(self.0.span()))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        if name == WITH_PLACE {
            PLACE.set(Some(self.0.span()));
        }
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.deserialize_map(visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Refused> {
        self.deserialize_seq(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        match self.0.get_ref() {
            DeValue::String(text) => {
                visitor.visit_enum(IntoDeserializer::<Refused>::into_deserializer(&**text))
            }
            DeValue::Table(table) => match table.iter().next().filter(|_| table.len() == 1) {
                Some((name, value)) => {
                    visitor.visit_enum(Variant { name: name.get_ref(), value: Reader(value) })
                }
                None => Err(de::Error::custom(format!(
                    "a table of one key is expected, this one has {}",
                    table.len()
                ))),
            },
            _ => Err(de::Error::custom("a text or a table is expected")),
        }
        .map_err(|refused| refused.within(self.0.span()))
    }

    forward_to_deserialize_any! {
        bool u8 u16 u32 u64 u128 i8 i16 i32 i64 i128 f32 f64 char str string bytes byte_buf unit ignored_any
        unit_struct tuple_struct identifier
    }
}

impl IntoDeserializer<'_, Refused> for Reader<'_, '_> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// A whole number as serde takes it.
enum Whole {
    Signed(i64),
    Unsigned(u64),
    None,
}

impl Whole {
    fn new(value: &DeValue<'_>) -> Self {
        let Some(whole) = whole(value) else { return Self::None };
        match (i64::try_from(whole), u64::try_from(whole)) {
            (Ok(whole), _) => Self::Signed(whole),
            (_, Ok(whole)) => Self::Unsigned(whole),
            _ => Self::None,
        }
    }
}

/// The elements of an array that are still to be read.
struct Elements<'a, 't>(std::slice::Iter<'a, Spanned<DeValue<'t>>>);

impl<'de> SeqAccess<'de> for Elements<'_, '_> {
    type Error = Refused;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Refused> {
        self.0.next().map(|element| seed.deserialize(Reader(element))).transpose()
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

/// What a table holds and is still to be read.
struct Entries<'a, 't, I: Iterator<Item = Entry<'a, 't>>> {
    entries: I,
    value: Option<&'a Spanned<DeValue<'t>>>,
}

/// A key and its value.
type Entry<'a, 't> = (&'a Spanned<toml::de::DeString<'t>>, &'a Spanned<DeValue<'t>>);

impl<'a, 't: 'a, 'de, I: Iterator<Item = Entry<'a, 't>>> MapAccess<'de> for Entries<'a, 't, I> {
    type Error = Refused;

    fn next_key_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>, Refused> {
        let Some((key, value)) = self.entries.next() else { return Ok(None) };
        self.value = Some(value);
        let name = StrDeserializer::<Refused>::new(key.get_ref());
        seed.deserialize(name).map(Some).map_err(|refused| refused.within(key.span()))
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value, Refused> {
        match self.value.take() {
            Some(value) => seed.deserialize(Reader(value)),
            None => Err(de::Error::custom("a value without a key")),
        }
    }
}

/// One of several things, named by the only key of a table.
struct Variant<'a, 't> {
    name: &'a str,
    value: Reader<'a, 't>,
}

impl<'a, 't, 'de> EnumAccess<'de> for Variant<'a, 't> {
    type Error = Refused;
    type Variant = Reader<'a, 't>;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self::Variant), Refused> {
        Ok((seed.deserialize(StrDeserializer::<Refused>::new(self.name))?, self.value))
    }
}

impl<'de> VariantAccess<'de> for Reader<'_, '_> {
    type Error = Refused;

    fn unit_variant(self) -> Result<(), Refused> {
        Err(de::Error::custom("it takes no table"))
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value, Refused> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Refused> {
        self.deserialize_seq(visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.deserialize_map(visitor)
    }
}
