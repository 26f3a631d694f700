//! One entry of `methods` becomes methods: the product of its lists, with names.

use crate::fem::{Element, Mass, Sampling};
use crate::mpm::{BasisName, FrameName, MassName, SchemeName, TransferChoice};
use crate::subject::Start;
use crate::suite::grammar::{EquationName, MethodSpec};
use crate::suite::model::method::Method;
use crate::suite::yaml::OneOrMany;

/// The product of one entry of `methods`. A choice enters the name where there is one, or where
/// it always has to be made.
pub(crate) fn methods(spec: &MethodSpec, own_law: EquationName) -> Vec<(String, Method)> {
    match spec {
        MethodSpec::Mpm { basis, transfer, scheme, start, mass, frame } => {
            let mut all = Vec::new();
            let starts = choices(start.as_ref(), Start::AtZero, Start::name);
            let masses = choices(mass.as_ref(), MassName::Lumped, MassName::name);
            let frames = choices(frame.as_ref(), FrameName::Updated, FrameName::name);
            let rest = product(&product(&starts, &masses), &frames);
            let pairs =
                product(&named(basis, BasisName::name), &named(transfer, TransferChoice::name));
            for (name, ((basis, transfer), scheme)) in
                product(&pairs, &named(scheme, SchemeName::name))
            {
                for (suffix, ((start, mass), frame)) in &rest {
                    let (start, mass, frame) = (*start, *mass, *frame);
                    let method = Method::Mpm { basis, transfer, scheme, start, mass, frame };
                    all.push((format!("mpm{name}{suffix}"), method));
                }
            }
            all
        }
        MethodSpec::Heat { basis } => named(basis, BasisName::name)
            .into_iter()
            .map(|(name, basis)| (format!("heat{name}"), Method::Heat { basis }))
            .collect(),
        MethodSpec::Fem { element, mass, law, start, sampling } => {
            let mut all = Vec::new();
            let laws = choices(law.as_ref(), own_law, EquationName::name);
            let starts = choices(start.as_ref(), Start::AtZero, Start::name);
            let samplings = choices(sampling.as_ref(), Sampling::Inside, Sampling::name);
            let rest = product(&product(&laws, &starts), &samplings);
            for (name, (element, mass)) in
                product(&named(element, Element::name), &named(mass, Mass::name))
            {
                for (suffix, ((law, start), sampling)) in &rest {
                    let (law, start, sampling) = (*law, *start, *sampling);
                    let method = Method::Fem { element, mass, law, start, sampling };
                    all.push((format!("fem{name}{suffix}"), method));
                }
            }
            all
        }
    }
}

/// A member of a list with what it adds to the name of a case.
type Choice<T> = (String, T);

/// All pairs, the second list running fastest.
fn product<A: Copy, B: Copy>(first: &[Choice<A>], second: &[Choice<B>]) -> Vec<Choice<(A, B)>> {
    let pair = |(a, x): &Choice<A>, (b, y): &Choice<B>| (format!("{a}{b}"), (*x, *y));
    first.iter().flat_map(|first| second.iter().map(move |second| pair(first, second))).collect()
}

/// The members of a list that has to be given, each of which is part of the name.
fn named<T: Copy, N: AsRef<str>>(list: &OneOrMany<T>, name: fn(T) -> N) -> Vec<Choice<T>> {
    let suffix = |member: T| format!("-{}", name(member).as_ref().replace('_', "-"));
    list.as_slice().iter().map(|member| (suffix(*member), *member)).collect()
}

/// The members of an optional list with the suffix that each gives to a name: none where there is
/// no choice.
fn choices<T: Copy>(
    list: Option<&OneOrMany<T>>,
    default: T,
    name: fn(T) -> &'static str,
) -> Vec<Choice<T>> {
    match list.map_or(&[][..], OneOrMany::as_slice) {
        [] => vec![(String::new(), default)],
        [only] => vec![(String::new(), *only)],
        many => many.iter().map(|m| (format!("-{}", name(*m).replace('_', "-")), *m)).collect(),
    }
}
