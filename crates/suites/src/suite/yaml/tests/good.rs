//! Tests that valid input is parsed as intended and located correctly.

use super::{Basis, Load, Material, Method, SAMPLE, Scheme, Suite};
use crate::suite::yaml::{NumberText, OneOrMany, Ordered, Source, Step, read};
use rstest::rstest;
use serde::Deserialize;

fn number(value: f64) -> NumberText {
    NumberText::Number(value)
}

fn formula(text: &str) -> NumberText {
    NumberText::Formula(text.to_owned())
}

fn text<T: serde::de::DeserializeOwned>(yaml: &str) -> T {
    read(&Source::from_text("good.yaml", yaml).unwrap()).unwrap()
}

#[test]
fn sample_is_parsed_as_intended() {
    let suite: Suite = text(SAMPLE);
    let names: Vec<&str> = suite.parameters.as_slice().iter().map(|(k, _)| k.as_str()).collect();
    assert_eq!(names, ["L", "E", "rho", "omega"]);
    assert_eq!(suite.parameters.get("L"), Some(&number(25.0)));
    assert_eq!(suite.parameters.get("omega"), Some(&formula("pi/(2*L)*sqrt(E/rho)")));
    assert_eq!(suite.scene.loads[0], Load::Gravity(vec![formula("-g")]));
    let Method::Mpm(mpm) = &suite.methods[0];
    assert_eq!(mpm.basis, Basis::Linear);
    assert_eq!(mpm.scheme.as_slice(), [Scheme::Musl, Scheme::Usl]);
}

#[test]
fn one_or_many_takes_every_form_of_its_type() {
    #[derive(Debug, Deserialize, PartialEq)]
    struct Forms {
        whole: OneOrMany<i32>,
        real: OneOrMany<f64>,
        flag: OneOrMany<bool>,
        word: OneOrMany<String>,
        formula: OneOrMany<NumberText>,
        bare: OneOrMany<Material>,
        with_settings: OneOrMany<Material>,
        mixed: OneOrMany<Material>,
        maps: OneOrMany<Ordered<OneOrMany<Scheme>>>,
    }
    let forms: Forms = text(
        "{whole: -3, real: 2, flag: true, word: a, formula: 2*L, bare: rigid,\n\
         with_settings: {linear_elastic: {young: [1, E], poisson: 0, density: 1}},\n\
         mixed: [rigid, {neo_hookean: {young: 1}}], maps: {a: musl, b: [usl]}}",
    );
    assert_eq!(forms.whole.as_slice(), [-3]);
    assert_eq!(forms.real, 2.0.into());
    assert_eq!(forms.formula.as_slice(), [formula("2*L")]);
    assert_eq!(forms.bare.as_slice(), [Material::Rigid]);
    let Material::LinearElastic(elastic) = &forms.with_settings.as_slice()[0] else { panic!() };
    assert_eq!(elastic.young.as_slice(), [number(1.0), formula("E")]);
    let neo_hookean = Material::NeoHookean { young: number(1.0) };
    assert_eq!(forms.mixed.as_slice(), [Material::Rigid, neo_hookean]);
    assert_eq!(forms.maps.as_slice()[0].as_slice().len(), 2);
}

#[rstest]
#[case("25", number(25.0), "25")]
#[case("-4", number(-4.0), "-4")]
#[case("1e-3", number(1e-3), "0.001")]
#[case("1e300", number(1e300), "1e300")]
#[case("0x10", number(16.0), "16")]
#[case("2*L", formula("2*L"), "2*L")]
#[case("'25'", formula("25"), "25")]
#[case("340282366920938463463374607431768211455", number(u128::MAX as f64), "3.402823669209385e38")]
#[case("-9223372036854775809", number(-9.223_372_036_854_776e18), "-9.223372036854776e18")]
fn number_text_preserves_the_source_text(
    #[case] yaml: &str,
    #[case] want: NumberText,
    #[case] shown: &str,
) {
    let value: NumberText = text(yaml);
    assert_eq!(value, want);
    assert_eq!(value.to_string(), shown);
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_change_nothing() {
    let windows = format!("\u{feff}{}", SAMPLE.replace('\n', "\r\n"));
    assert_eq!(text::<Suite>(&windows), text::<Suite>(SAMPLE));
}

fn steps(path: &str) -> Vec<Step> {
    path.split('.')
        .filter(|step| !step.is_empty())
        .map(|step| step.parse::<usize>().map_or_else(|_| Step::from(step), Step::from))
        .collect()
}

#[rstest]
#[case("suite", 1, 8, "vibrating-bar")]
#[case("parameters.omega", 2, 44, "\"pi/(2*L)*sqrt(E/rho)\"")]
#[case("scene", 4, 3, "dimension")]
#[case("scene.material", 6, 13, "{")]
#[case("scene.material.linear_elastic.density", 6, 62, "rho")]
#[case("scene.loads.1.traction.value.0", 8, 61, "\"p0\"")]
#[case("refine.cells", 9, 17, "[")]
#[case("refine.cells.2", 9, 25, "20")]
#[case("methods", 11, 3, "-")]
#[case("methods.0.mpm.scheme.1", 11, 57, "usl")]
#[case("expect.0.order.0", 13, 14, "1.9")]
#[case("", 1, 1, "suite")]
fn a_value_is_found(
    #[case] path: &str,
    #[case] line: usize,
    #[case] column: usize,
    #[case] token: &str,
) {
    let source = Source::from_text("sample.yaml", SAMPLE).unwrap();
    let place = source.value_at(&steps(path)).unwrap();
    assert_eq!((place.line(), place.column()), (line, column));
    assert_eq!(&SAMPLE[place.bytes()], token);
}

#[test]
fn a_block_of_text_may_be_the_whole_file() {
    let source = Source::from_text("text.yaml", "|\n  a\n").unwrap();
    assert_eq!(source.scalar_at(0).map(|scalar| scalar.range.clone()), Some(0..5));
}

#[test]
fn a_key_is_found_and_what_is_not_there_is_not() {
    let source = Source::from_text("sample.yaml", SAMPLE).unwrap();
    let key = source.key_at(&steps("scene.loads.1.traction.on")).unwrap();
    assert_eq!((key.line(), key.column(), key.length()), (8, 42, 2));
    for path in ["scene.colour", "refine.cells.3", "suite.name", "suite.0", "refine.0", "methods.a"]
    {
        assert_eq!(source.value_at(&steps(path)), None, "{path}");
        assert_eq!(source.key_at(&steps(path)), None, "{path}");
    }
}

/// Forms that are valid, but rare in suites.
#[rstest]
#[case::stated_keys("a:\n- b:\n    ? c\n    : 1\n    d: 2\n  e: 3\n- {? f : g}\n")]
#[case::closed_at_the_key("a:\n  b: {\n    c: 1,\n  }\n  d: [\n    1\n  ]\n")]
#[case::json("{\"a\": [\n1,\n{\"b\": \"c: [d\"}\n]}")]
#[case::marks("%YAML 1.2\n---\na: 1\n...\n")]
#[case::brackets_in_text("a: b [c] {d\ne: 'f [' # ] {\ng: |\n  [h\n  \ti\n")]
#[case::lines("a: b\n  c\nd: \"e\n  f\"\n")]
fn a_valid_form_is_read(#[case] yaml: &str) {
    let values: serde_yaml::Value = text(yaml);
    assert_eq!(values, serde_yaml::from_str::<serde_yaml::Value>(yaml).unwrap());
}

#[rstest]
#[case::of_negative_numbers("a:\n- -1\n- 2", (2, 1))]
#[case::behind_a_comment("a:\n- # c - d\n    U\n", (2, 1))]
#[case::nested("a:\n- - 1\n  - 2", (2, 1))]
#[case::indented("a:\n  - b", (2, 3))]
#[case::in_brackets("a: # -\n  [-1]", (2, 3))]
#[case::missing("a:", (1, 3))]
fn the_start_of_a_value_is_found(#[case] yaml: &str, #[case] want: (usize, usize)) {
    let source = Source::from_text("list.yaml", yaml).unwrap();
    let place = source.value_at(&["a".into()]).unwrap();
    assert_eq!((place.line(), place.column()), want);
}

#[rstest]
#[case::plain("é: 2*L+M", 4..5, (1, 8, 1))]
#[case::double_quoted("é: \"2*L+M\"", 4..5, (1, 9, 1))]
#[case::single_quoted("é: '2*L+M'", 4..5, (1, 9, 1))]
#[case::other_alphabet("é: 'ω*ü'", 3..5, (1, 7, 1))]
#[case::end_of_the_value("é: '2*L'", 3..3, (1, 8, 0))]
#[case::escape("é: \"2*\\u0041\"", 2..3, (1, 4, 10))]
#[case::doubled_quote("é: '2''L'", 2..3, (1, 4, 6))]
#[case::single_quoted_before_a_comment("é: '2*L'  # it's so", 2..9, (1, 4, 5))]
#[case::double_quoted_before_a_comment("é: \"2\\\"L\" # \"so\"", 2..3, (1, 4, 6))]
#[case::block_before_a_comment("é: > # a|b\n  2*L", 2..3, (1, 4, 7))]
#[case::block_after_a_key_with_a_bar("'b|c': |\n  x\né: |\t# x | y\n  2*L", 2..3, (3, 4, 9))]
#[case::empty_block("b|é: 1\né: |", 2..3, (2, 4, 1))]
#[case::block("é: |\n  2*L", 2..3, (1, 4, 1))]
#[case::after_a_block_of_stated_indentation("t: |2-\n    deep\n  [no list\né: 2*L+M", 4..5, (4, 8, 1))]
#[case::folded("é: 2*\n  L", 2..3, (1, 4, 2))]
#[case::not_text("é: [2]", 0..1, (1, 4, 1))]
#[case::too_long("é: 2*L", 2..9, (1, 4, 3))]
#[case::out_of_range("é: 2*L", 1..usize::MAX, (1, 4, 3))]
fn a_part_of_a_value_is_found_where_it_stands_verbatim(
    #[case] yaml: &str,
    #[case] bytes: std::ops::Range<usize>,
    #[case] want: (usize, usize, usize),
) {
    let source = Source::from_text("formula.yaml", yaml).unwrap();
    let place = source.within(&["é".into()], bytes).unwrap();
    assert_eq!((place.line(), place.column(), place.length()), want);
    assert_eq!(source.diagnostic(place, "no").place(), Some(place));
}
