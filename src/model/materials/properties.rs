//! Lines `KEYWORD value` of a group: the properties of a material or of an equation of state.

use crate::model::problem::Draft;
use crate::{
    deck::{Absent, Agreement, Card, Diagnostic, FieldReader, FieldRule, Kind, Row, Span, Spelled, spelling},
    material::{Entry, Property, Range},
};

/// The properties that a group may have.
pub(in crate::model) struct Properties {
    /// Who has them, e.g. `MATERIAL 3`.
    pub owner: String,
    /// Name of the model.
    pub name: &'static str,
    /// The properties.
    pub properties: &'static [Property],
    /// Models of the same kind and their properties, to help those who mix them up.
    pub kin: Vec<(&'static str, &'static [Property])>,
}

impl Properties {
    /// Of a model, for the group that a card heads.
    pub fn new<T>(card: &Card, entry: &'static Entry<T>, all: &[&'static Entry<T>]) -> Properties {
        let owner = card.maybe_integer("block").map_or(card.name.clone(), |block| format!("{} {block}", card.name));
        let kin = all.iter().map(|entry| (entry.name, entry.properties)).collect();
        Properties { owner, name: entry.name, properties: entry.properties, kin }
    }

    /// The values of all properties in their own order; `None` if a line is wrong or a property is missing.
    pub fn values(&self, card: &Card, draft: &mut Draft) -> Option<Vec<f64>> {
        let mut given: Vec<Option<(f64, Span)>> = vec![None; self.properties.len()];
        // Lines with a mistake, which has been reported.
        let mut wrong: Vec<&Row> = Vec::new();
        for row in &card.rows {
            if draft.found.is_full() {
                break;
            }
            match self.value(row, draft) {
                Some((index, value)) if given[index].is_none() => given[index] = Some((value, row.span())),
                Some((index, _)) => {
                    wrong.push(row);
                    self.report_twice(&self.properties[index], row, given[index], draft);
                }
                None => wrong.push(row),
            }
        }
        let missing: Vec<&Property> = self
            .properties
            .iter()
            .zip(&given)
            .filter(|(property, value)| property.default.is_none() && value.is_none())
            .map(|(property, _)| property)
            .collect();
        let meant: Vec<&str> = wrong.iter().filter_map(|row| meant(row, &missing)).collect();
        let forgotten: Vec<&Property> = missing.into_iter().filter(|p| !meant.contains(&p.keyword)).collect();
        if !forgotten.is_empty() {
            draft.report(self.missing(card, &forgotten));
        }
        // A property that is missing without being forgotten is meant by a wrong line.
        let values = self.properties.iter().zip(&given).map(|(p, v)| v.map(|v| v.0).or(p.default));
        if wrong.is_empty() { values.collect() } else { None }
    }

    /// Reads a line `KEYWORD value`: which property it is, and the value.
    pub fn value(&self, row: &Row, draft: &mut Draft) -> Option<(usize, f64)> {
        let keywords = self.properties.iter().enumerate().map(|(i, p)| (p.keyword, i));
        match spelling::recognise(&row.fields, keywords) {
            Spelled::As { what, words, agreement, .. } => {
                let property = &self.properties[what];
                if agreement == Agreement::Abbreviated {
                    let written = row.fields[0].span.join(row.fields[words - 1].span);
                    let written = draft.deck.source.slice(written).to_string();
                    draft.report(
                        Diagnostic::note(format!("assumed {} for `{written}`", property.keyword)).at(row.span(), ""),
                    );
                }
                let rule = rule(property);
                let form = format!("{} = value", property.keyword);
                let end = Span { start: row.span().end, end: row.span().end };
                let mut reader = FieldReader { owner: &self.owner, form: &form, end, diagnostics: &mut draft.found };
                let (values, complete) = reader.read(&[rule], &row.fields[words..]);
                let field = values.first()?.1.first()?;
                let value = field.value.number()?;
                let place = field.span.unwrap_or_default();
                let sound = complete
                    && (property.range != Range::Function || draft.names_function(value as i64, place, &self.owner));
                sound.then_some((what, value))
            }
            Spelled::Several(names) => {
                let words = format!("{}: {}", self.owner, row.fields[0].text);
                draft.report(Diagnostic::unclear(words, &names, row.fields[0].span));
                None
            }
            Spelled::Nothing => {
                draft.report(self.unknown(row));
                None
            }
        }
    }

    fn unknown(&self, row: &Row) -> Diagnostic {
        let words = row.fields.iter().take_while(|f| f.is_word()).count();
        let Some(last) = row.fields[..words].last() else {
            return Diagnostic::error(format!("{}: a line starts with the keyword of a property", self.owner))
                .at(row.fields[0].span, "expected a keyword")
                .help(self.list());
        };
        let shown = spelling::shown(&row.fields[..words]);
        let place = row.fields[0].span.join(last.span);
        let near = resembling(row, self.properties.iter().map(|p| p.keyword));
        let others: Vec<&str> = self
            .kin
            .iter()
            .filter(|(_, properties)| properties.iter().any(|p| spelling::agreement(&row.fields, p.keyword).is_some()))
            .map(|(name, _)| *name)
            .collect();
        let elsewhere = format!("{} is a property of {}", shown, spelling::all(&others));
        Diagnostic::error(format!("{}: {} has no property {shown}", self.owner, self.name))
            .at(place, "unknown keyword")
            .help(near.map_or(String::new(), |keyword| format!("did you mean {keyword}?")))
            .help(if others.is_empty() { String::new() } else { elsewhere })
            .help(self.list())
    }

    fn list(&self) -> String {
        let keywords: Vec<&str> = self.properties.iter().map(|p| p.keyword).collect();
        format!("the properties of {} are {}", self.name, spelling::all(&keywords))
    }

    fn report_twice(&self, property: &Property, row: &Row, first: Option<(f64, Span)>, draft: &mut Draft) {
        let message = format!("{}: {} is given twice", self.owner, property.keyword);
        let mut diagnostic = Diagnostic::error(message).at(row.span(), "the second one");
        if let Some((_, span)) = first {
            diagnostic = diagnostic.at(span, "the first one");
        }
        draft.report(diagnostic.help(self.list()));
    }

    fn missing(&self, card: &Card, missing: &[&Property]) -> Diagnostic {
        let keywords: Vec<&str> = missing.iter().map(|p| p.keyword).collect();
        let verb = if missing.len() == 1 { "is" } else { "are" };
        let mut diagnostic = Diagnostic::error(format!("{}: {} {verb} missing", self.owner, spelling::all(&keywords)))
            .at(card.record, format!("expected between this line and END: {}", spelling::all(&keywords)));
        for property in missing {
            let (meaning, unit) = (property.meaning.trim_end_matches('.'), property.dimension);
            let unit = if unit == "-" { String::new() } else { format!(" [{unit}]") };
            let expected = rule(property).expected();
            diagnostic = diagnostic.help(format!("{}: {meaning}{unit}, {expected}", property.keyword));
        }
        diagnostic
    }
}

/// The one of the missing properties that a line with a mistake means: to call it missing too would be to tell one mistake
/// twice.
fn meant(wrong: &Row, missing: &[&Property]) -> Option<&'static str> {
    let keywords = || missing.iter().map(|property| property.keyword);
    keywords()
        .find(|keyword| spelling::agreement(&wrong.fields, keyword).is_some())
        .or_else(|| resembling(wrong, keywords()))
}

/// The keyword that a line may mean: a near one, or the one whose first word it starts with.
fn resembling(row: &Row, mut keywords: impl Iterator<Item = &'static str> + Clone) -> Option<&'static str> {
    let near = spelling::nearest_start(&row.fields, keywords.clone()).map(|(keyword, _)| keyword);
    near.or_else(|| {
        let first = row.fields.first().filter(|f| f.is_word())?;
        let first_words = || keywords.clone().filter_map(|keyword| keyword.split(' ').next());
        let near = spelling::nearest(&first.text, first_words())?;
        keywords.find(|keyword| keyword.split(' ').next() == Some(near))
    })
}

/// A property as the rule of a field.
fn rule(property: &Property) -> FieldRule {
    FieldRule {
        name: property.keyword.to_string(),
        repeats: false,
        kind: if property.range == Range::Function { Kind::Id("function") } else { Kind::Number },
        default: property.default.map_or(Absent::Required, |value| Absent::Value(value.to_string())),
        range: property.range,
        unit: property.dimension.to_string(),
        meaning: property.meaning.to_string(),
    }
}
