//! The parameters of a law, declared once: a field of the law says which properties of the deck it is read from. Reading,
//! echo and manual follow.

use super::Property;
use super::property::{Curve, Given, Refusal};

/// Declares a law, or an equation of state, by its parameters. A field is followed by the property that it is read from; an
/// array by as many, in brackets. What is not a parameter of the deck comes in a second list, `with { … }`, each field with
/// an expression in `given` that makes it.
///
/// The type gets `PROPERTIES`, the properties in the order of the fields, which is that of manual and print log; `read`, which
/// makes it from what a deck gives; and `values`, the parameters as numbers in the order of `PROPERTIES`.
macro_rules! parameters {
    (
        $(#[$of_law:meta])*
        pub struct $law:ident { $($(#[$of_field:meta])* pub $field:ident: $type:ty = [$($property:expr),+ $(,)?]),+ $(,)? }
        $(with($given:ident) { $($(#[$of_other:meta])* pub $other:ident: $other_type:ty = $from:expr),+ $(,)? })?
    ) => {
        $(#[$of_law])*
        pub struct $law {
            $($(#[$of_field])* pub $field: $type,)+
            $($($(#[$of_other])* pub $other: $other_type,)+)?
        }

        impl $law {
            /// Its parameters, in the order of manual and print log.
            pub(in $crate::material) const PROPERTIES: &'static [$crate::material::Property] = &[$($($property),+),+];

            /// Makes it from what a deck gives.
            ///
            /// # Errors
            ///
            /// A property names a function that is not there.
            pub(in $crate::material) fn read(given: &$crate::material::Given) -> Result<$law, $crate::material::Refusal> {
                let mut parameters = $crate::material::parameters::Parameters::new(given, Self::PROPERTIES);
                $($(let $other = { let $given = given; $from };)+)?
                Ok($law { $($field: parameters.take()?,)+ $($($other,)+)? })
            }

            /// Its parameters as numbers.
            pub(in $crate::material) fn values(&self) -> Vec<f64> {
                let mut values = Vec::with_capacity(Self::PROPERTIES.len());
                $($crate::material::parameters::Parameter::tell(&self.$field, &mut values);)+
                values
            }
        }

        // A field takes as many properties as stand behind it.
        $(const _: () = assert!(
            <$type as $crate::material::parameters::Parameter>::COUNT == [$(stringify!($property)),+].len()
        );)+
    };
}

/// What a field of a law may be.
pub(super) trait Parameter: Sized {
    /// Number of properties that it is read from.
    const COUNT: usize;

    /// Takes it from the next properties.
    ///
    /// # Errors
    ///
    /// A property names a function that is not there.
    fn take(parameters: &mut Parameters) -> Result<Self, Refusal>;

    /// Appends its values.
    fn tell(&self, values: &mut Vec<f64>);
}

/// The values of a deck's properties, taken one after the other.
pub(super) struct Parameters<'a> {
    given: &'a Given<'a>,
    properties: &'static [Property],
    next: usize,
}

impl<'a> Parameters<'a> {
    /// The values that a deck gives for these properties, from the first on.
    pub fn new(given: &'a Given<'a>, properties: &'static [Property]) -> Parameters<'a> {
        Parameters { given, properties, next: 0 }
    }

    /// The next field.
    ///
    /// # Errors
    ///
    /// A property names a function that is not there.
    pub fn take<T: Parameter>(&mut self) -> Result<T, Refusal> {
        T::take(self)
    }

    fn place(&mut self) -> usize {
        self.next += 1;
        self.next - 1
    }
}

impl Parameter for f64 {
    const COUNT: usize = 1;

    fn take(parameters: &mut Parameters) -> Result<f64, Refusal> {
        let place = parameters.place();
        Ok(parameters.given.values[place])
    }

    fn tell(&self, values: &mut Vec<f64>) {
        values.push(*self);
    }
}

impl Parameter for Curve {
    const COUNT: usize = 1;

    fn take(parameters: &mut Parameters) -> Result<Curve, Refusal> {
        let place = parameters.place();
        parameters.given.curve(place, parameters.properties[place].keyword)
    }

    fn tell(&self, values: &mut Vec<f64>) {
        values.push(self.id as f64);
    }
}

impl<T: Parameter, const N: usize> Parameter for [T; N] {
    const COUNT: usize = N * T::COUNT;

    fn take(parameters: &mut Parameters) -> Result<[T; N], Refusal> {
        let taken: Vec<T> = (0..N).map(|_| T::take(parameters)).collect::<Result<_, _>>()?;
        Ok(taken.try_into().unwrap_or_else(|_| unreachable!("as many were taken")))
    }

    fn tell(&self, values: &mut Vec<f64>) {
        self.iter().for_each(|one| one.tell(values));
    }
}
