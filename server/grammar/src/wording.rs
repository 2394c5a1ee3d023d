//! What can be said of a text: a row for each sentence, with what to write instead. Places for values stand in braces.
//!
//! The page has the same rows in its own languages (`grammar-problems.ts`): it finds a sentence by its name, and fills in
//! the values. `UPDATE_GOLDEN=1 cargo test -p espalier-grammar highlighting` writes the names to the client.

use std::fmt::Write;

/// A sentence about a text.
#[derive(Debug, PartialEq, Eq)]
pub struct Wording {
    /// Its name: a kind, or a kind and what tells it from others of that kind: `bracket.unclosed`.
    pub id: &'static str,
    /// The sentence in English, without its full stop.
    pub message: &'static str,
    /// What to write instead.
    pub hint: Option<&'static str>,
}

impl Wording {
    /// What kind of sentence it is; programs branch on it.
    pub fn kind(&self) -> &'static str {
        self.id.split_once('.').map_or(self.id, |(kind, _)| kind)
    }
}

/// Puts values where their names stand in braces.
pub(crate) fn filled(template: &str, values: &[(&'static str, String)]) -> String {
    let mut text = String::with_capacity(template.len() + 16);
    let mut rest = template;
    while let Some((before, behind)) = rest.split_once('{') {
        text += before;
        let value = behind.split_once('}').and_then(|(name, after)| {
            values.iter().find(|value| value.0 == name).map(|value| (&*value.1, after))
        });
        match value {
            Some((value, after)) => {
                text += value;
                rest = after;
            }
            None => {
                let _always = text.write_char('{');
                rest = behind;
            }
        }
    }
    text + rest
}

macro_rules! wordings {
    ($($name:ident: $id:literal, $message:literal $(=> $hint:literal)?;)*) => {
        $(pub(crate) const $name: &Wording = &Wording { id: $id, message: $message, hint: wordings!(@ $($hint)?) };)*
        /// All sentences.
        pub const WORDINGS: &[&Wording] = &[$($name),*];
    };
    (@) => { None };
    (@ $hint:literal) => { Some($hint) };
}

wordings! {
    NO_TEXT: "no-text", "it is not text in UTF-8 from here on";
    FILE_TOO_LONG: "too-long.file", "a grammar has at most {most} KiB";
    STRING_TOO_LONG: "too-long.string", "the string is too long, or its brackets lie too deep in each other";
    TOO_DEEP: "too-deep.levels", "it lies more than {most} deep";
    CHAIN_TOO_LONG: "too-deep.chain", "the expression is too long";
    TOO_MANY_RULES: "too-many-rules", "a grammar has at most {most} rules";
    TOO_MANY_SYMBOLS: "too-many-symbols", "there are too many names";

    UNOPENED: "bracket.unopened", "`]` ends a branch that has not begun";
    UNCLOSED: "bracket.unclosed", "this branch has no end: `]` is missing";
    REWRITTEN_BRACKET: "bracket.rewritten", "brackets cannot be rewritten";
    MISSING_BEFORE: "missing.before", "`{wanted}` is missing before `{found}`";
    MISSING_AT_END: "missing.end", "`{wanted}` is missing at the end";
    UNEXPECTED: "unexpected", "nothing more is expected on this line";

    NO_EXPRESSION: "no-expression.here", "`{found}` begins no number, name or parenthesis";
    MISSING_EXPRESSION: "no-expression.missing", "a number or a name is missing here";
    BAD_NUMBER: "bad-number", "it is no number";
    ASSIGNMENT: "assignment", "`=` compares nothing" => "write ==";
    UNKNOWN_NAME: "unknown-name.here", "`{name}` is no parameter of this rule and is not defined"
        => "define it on a line of its own: {name} = 1";
    UNKNOWN_NAME_NEAR: "unknown-name.near", "`{name}` is no parameter of this rule and is not defined"
        => "did you mean {near}?";
    NAME_OF_FUNCTION: "unknown-name.function", "`{name}` is no parameter of this rule and is not defined"
        => "write {name}(…)";
    NAME_OF_MODULES: "unknown-name.modules", "`{name}` is defined as modules, not as a number";
    UNDEFINED: "unknown-name.slider", "`{name}` is not defined" => "write {name} = 1";
    UNDEFINED_NEAR: "unknown-name.slider-near", "`{name}` is not defined" => "did you mean {near}?";
    UNKNOWN_FUNCTION: "unknown-function.here", "there is no function `{name}`";
    UNKNOWN_FUNCTION_NEAR: "unknown-function.near", "there is no function `{name}`" => "did you mean {near}?";
    CPFG_FUNCTION: "unknown-function.cpfg", "`{name}` is a function of cpfg that is not known here"
        => "docs/grammars.md lists the functions";
    UNKNOWN_CURVE: "unknown-curve.name", "there is no curve `{name}`" => "define it: func: {name} 0 0 1 1";
    UNKNOWN_CURVE_NUMBER: "unknown-curve.number", "curve {name} lies in another file of cpfg"
        => "write its points into this one: func: {name} 0 0 0.5 0.8 1 1";

    ARGUMENT_COUNT: "parameter-count.function", "`{name}` takes {wanted} parameters, not {count}";
    TOO_FEW_PARAMETERS: "parameter-count.least", "`{name}` needs {least} parameters, and {count} are here";
    TOO_MANY_PARAMETERS: "parameter-count.most", "a module has at most {most} parameters";
    FRAME_FULL: "parameter-count.contexts", "a predecessor has at most {most} parameters with its contexts";
    BRACKET_PARAMETERS: "parameter-count.brackets", "brackets have no parameters";
    NO_RULE_TAKES: "parameter-count.rules", "no rule takes `{name}` with {count} parameters";

    PYTHON_OPERATOR: "python.operator", "`{name}` is Python" => "write {sign}";
    BITS: "python.bits", "`{name}` joins bits in Python and C" => "write {sign}";
    TURTLE_WORD: "python.turtle", "`{name}` is a word of L-Py for what the turtle does"
        => "write {sign}, or module {name} for a module of your own";
    PYTHON_FUNCTION: "python.function", "`{name}` is Python, which is not run here"
        => "a grammar has no functions of its own; func: defines curves";
    PYTHON_IMPORT: "python.import", "`{name}` is Python, which is not run here" => "nothing is imported";
    PYTHON_LOOP: "python.loop", "`{name}` is Python or C, which is not run here"
        => "a rule acts on all modules at once; repeat by deriving further";
    PYTHON_IF: "python.if", "`{name}` is Python or C, which is not run here"
        => "write conditions into the rule: A(x) : x > 0 --> F";
    PYTHON_ELSE: "python.else", "`{name}` is Python or C, which is not run here" => "write a rule for each case";
    PYTHON_RETURN: "python.return", "`{name}` is Python or C, which is not run here" => "a rule is written A --> F";
    PYTHON_CLASS: "python.class", "`{name}` is Python, which is not run here" => "a grammar has no classes";
    PYTHON_PRINT: "python.print", "`{name}` is Python, which is not run here" => "a grammar prints nothing";
    PYTHON_GLOBAL: "python.global", "`{name}` is Python, which is not run here"
        => "definitions are numbers: R = 1.5";
    PYTHON_PRODUCE: "python.produce", "`{name}` is Python, which is not run here"
        => "write the successor behind the arrow: A --> F";
    PYTHON_CONTEXT: "python.context", "`{name}` is Python, which is not run here"
        => "contexts stand in rules: A < B > C --> D";
    PYTHON_BLOCK: "python.block", "a rule that ends with `:` goes on in Python, which is not run here"
        => "write the successor behind the arrow: A(x) --> F(x)";
    PYTHON_CALL: "python.call", "`{name}(…)` is a call of Python or C, which is not run here"
        => "definitions are numbers, and rules have the arrow: A --> F";
    PYTHON_CONSTANT: "python.constant", "`{name}` is Python, and definitions are numbers" => "write {sign}";
    PYTHON_METHOD: "python.method", "`{name}(…)` is a call of Python, which is not run here"
        => "definitions are numbers: R = 1.5";
    PYTHON_LIST: "python.list", "`{name}` is a list or a text, and definitions are numbers"
        => "give each number a name of its own, or make a curve of them: func: {name} 0 1 1 2";
    PYTHON_LAMBDA: "python.lambda", "`{name}` is Python, which is not run here"
        => "a grammar has no functions of its own; func: defines curves";
    PYTHON_COMPREHENSION: "python.comprehension", "a list made by `for` is Python, which is not run here"
        => "a rule acts on all modules at once; repeat by deriving further";
    PYTHON_LIST_HERE: "python.list-here", "`[` begins a list of Python here, and parameters are numbers"
        => "give each number a name of its own, or make a curve of them: func: name 0 1 1 2";
    PYTHON_TEXT: "python.text", "a text in quotes is Python or C here, and parameters are numbers"
        => "write a number: A(1)";
    PYTHON_LISTS: "python.lists", "`{name}(…)` is a function of Python, which is not run here"
        => "a grammar has no lists; give each number a name of its own, or make a curve of them: func: name 0 1 1 2";
    PYTHON_STRING: "python.string", "`{name}(…)` makes a string in Python, which is not run here"
        => "write its modules behind the axiom or an arrow: axiom: F[+F]A";
    PYTHON_CHANCE: "python.chance", "`{name}(…)` is a function of Python or C, which is not run here"
        => "write {sign}";
    PYTHON_STATEMENT: "python.statement", "`{name}` is Python, which is not run here"
        => "a grammar has no statements; definitions are numbers: R = 1.5";
    C_STATEMENT: "c.statement", "`{name}` is C, which is not run here"
        => "a grammar has no statements; definitions are numbers: R = 1.5";
    C_CAST: "c.cast", "`{name}(…)` is a function of Python or C, which is not run here"
        => "numbers are not of kinds here; write trunc(x) to cut off what is behind the point";
    C_STEP: "c.step", "`{name}` is C, which is not run here" => "write the new number into the successor: A(x) --> A(x+1)";
    STATEMENT_START: "cpfg-statements.start", "`{name}` is a statement, and none is run here"
        => "a grammar has no statements; definitions are numbers: R = 1.5";
    STATEMENT_EACH: "cpfg-statements.each", "`{name}` is a statement, and none is run here"
        => "a grammar has no statements; step is the number of the step";
    STATEMENT_END: "cpfg-statements.end", "`{name}` is a statement, and none is run here"
        => "a grammar has no statements";
    STATEMENT_KIND: "cpfg-statements.kind", "`{name}` is a statement, and none is run here"
        => "in braces only numbers are given names: A(x) : {y = 2*x;} --> F(y)";
    STATEMENT_NAME: "cpfg-statements.name", "statements cannot change `{name}`, which is defined for all rules"
        => "give the number a new name: A(x) : {y = x+1;} --> F(y)";
    STATEMENT_IN_SUCCESSOR: "cpfg-statements.successor", "statements in a rule stand before its arrow"
        => "a rule is predecessor : {y = 2*x;} condition --> successor";
    C_NUMBER: "c.number", "`{name}` is a statement, and none is run here" => "definitions are numbers: R = 1.5";
    C_FUNCTION: "c.function", "`{name}` is a statement, and none is run here"
        => "a grammar has no functions of its own; func: defines curves";
    C_STRUCT: "c.struct", "`{name}` is a statement, and none is run here"
        => "modules have numbers as parameters: A(1, 2)";
    C_ARRAY: "c.array", "`{name}` is a row of numbers of cpfg, which is not read"
        => "give each number a name of its own, or make a curve of them: func: name 0 1 1 2";
    C_DIRECTIVE: "c.directive", "`{name}` is a statement, and none is run here"
        => "of C's directives only #define NAME VALUE is read";
    MACRO_SEMICOLON: "c.semicolon", "`;` would be part of what `{name}` stands for" => "write #define {name} {value}";
    MACRO_PARAMETERS: "c.macro", "`{name}(…)` is a macro with parameters, which is not read"
        => "write what it stands for into the rules, or make a rule of it";
    MACRO_DEPTH: "c.macro-depth", "`{name}` stands for itself" => "a macro cannot hold its own name";
    GROUPS: "groups", "`{name}` is not supported" => "all rules belong to one group";
    SUB_L_SYSTEMS: "sub-l-systems", "`{name}` is not supported" => "a file holds one grammar";
    NEW_CONTEXT: "new-context", "`{name}` looks at what is being made, which is not supported"
        => "contexts look at the word before the step: A < B > C";
    HEADER: "header", "`{name}` begins no header by itself" => "write derivation length: 10";

    NO_RULE_XL: "no-rule.xl", "`{name}` is an arrow of another language, XL (GroIMP) or Fractint" => "rules have the arrow -->: A --> F";
    NO_RULE_BOOK: "no-rule.book", "`{name}` stands in books before a line" => "write axiom: for ω, and leave labels of rules out";
    ANGLE_FACTOR: "no-rule.angle", "`{name}` is a header of another program" => "write angle: and 360 divided by its number";
    NO_RULE: "no-rule.line", "it is neither a rule nor a header" => "a rule is written A --> F";
    NO_RULE_ARROW: "no-rule.arrow", "it is neither a rule nor a header" => "rules have the arrow -->";
    NO_COLON: "no-rule.colon", "`{name}` is a header, and its colon is missing" => "write {name}: {rest}";
    NO_AXIOM: "no-axiom", "it has no axiom" => "write axiom: F";
    NO_NAME: "no-name.here", "a name is missing here";
    NO_PARAMETER_NAME: "no-name.parameter", "a predecessor has names as parameters"
        => "compare in the condition: A(x) : x == 1 --> F";
    NO_MODULE: "no-symbol.here", "`{name}` is no module" => "names are letters, or declared: module Leaf";
    NO_MODULE_NUMBER: "no-symbol.number", "`{name}` is no module" => "numbers stand in parentheses: F(2); names of modules are letters";
    NO_MODULE_OPERATOR: "no-symbol.operator", "`{name}` is no module" => "only parameters are computed: F(2*x)";
    NO_TURTLE_SYMBOL: "no-symbol.turtle", "`{name}` is no symbol that the turtle knows here"
        => "docs/grammars.md lists the names that begin so";
    NO_SURFACE: "no-symbol.surface", "`~` names no surface" => "write ~l";
    MISSING_MODULE: "no-symbol.missing", "a module is missing here";
    NO_CHOICE: "no-choice", "it is none of the choices" => "{choices}";
    TWO_ARROWS: "two-arrows", "a rule has one arrow" => "begin each rule on its own line";
    TWO_MODULES: "predecessor.modules", "a rule rewrites one module"
        => "what stands beside it is a context: A < B > C";
    LONG_NAME: "predecessor.name", "a rule rewrites one module, and `{name}` is read as {count} of one letter each"
        => "declare the name above: module {name}";
    ODD_CONTEXTS: "bad-context.sides", "the contexts cannot be told apart" => "left < module > right";
    LEFT_BRACKETS: "bad-context.brackets", "a left context has no brackets"
        => "to the left stands the way to the root, which has no side branches";
    MISPLACED_CONTEXT: "misplaced.context", "rules of homomorphism and decomposition have no contexts";
    MISPLACED_DEPTH: "misplaced.depth", "productions have no maximum depth"
        => "write it below homomorphism: or decomposition:";

    HEADER_TWICE: "twice.header", "`{name}` stands twice";
    DEFINED_TWICE: "twice.name", "`{name}` is defined twice";
    SLIDER_TWICE: "twice.slider", "`{name}` has two sliders";
    LIFESPAN_TWICE: "twice.lifespan", "`{name}` has two lifespans";
    PROBABILITY_TWICE: "twice.probability", "the rule has two probabilities";
    PARAMETER_TWICE: "twice.parameter", "`{name}` names two parameters";
    EMPTY_RANGE: "empty-range", "from {from} to {to} is no range";
    BAD_CURVE: "bad-curve", "these are no points of a curve"
        => "func: name x0 y0 x1 y1, with x in ascending order";
    MAXIMUM_DEPTH: "out-of-range.maximum-depth", "a maximum depth is a whole number from 1";
    DEPTH_TAKEN: "out-of-range.depth-taken", "a maximum depth of {value} is read as {most}, which is the most";
    NO_SLIDER: "out-of-range.no-slider", "there is no slider `{name}`";
    BEYOND_SLIDER: "out-of-range.slider", "`{name}` goes from {from} to {to}";
    NOT_FINITE: "out-of-range.finite", "`{name}` is {value}, and must be a finite number";
    SCALE_RANGE: "out-of-range.scale", "scale is {value}, and must be more than 0";
    ANGLE_RANGE: "out-of-range.angle", "angle is {value}, and must be a finite number of degrees";
    TIME_STEP_RANGE: "out-of-range.dt", "dt is {value}, and must be from 0.001 to 1000";
    SEED_RANGE: "out-of-range.seed", "seed is {value}, and must be a whole number from 0 to 4294967295";
    DEPTH_RANGE: "out-of-range.depth", "derivation length is {value}, and must be a whole number up to 1000";
    LIFESPAN_RANGE: "out-of-range.lifespan", "the lifespan of `{name}` is {value}, and must be from 0.001 to 1000000";
    UNSTEADY: "out-of-range.unsteady", "`{name}` must be the same everywhere, and `{function}` is not";
    NO_PROBABILITY: "no-probability", "the probabilities of this rule and its alternatives are all 0";

    ENDS_MODULES: "ends.modules", "the next step has more than {most} modules";
    ENDS_PARAMETERS: "ends.parameters", "the modules of the next step have more than {most} parameters in all";
    ENDS_NESTING: "ends.nesting", "branches lie more than {most} deep in each other";
    ENDS_WORK: "ends.work", "it takes more than {most} steps of computing";
    ENDS_NO_NUMBER: "ends.no-number", "line {line}, column {column}: a number is infinite or undefined (a division by 0, say)";
    ENDS_NO_PROBABILITY: "ends.no-probability", "line {line}, column {column}: the probabilities of the alternatives are not all 0 or more, or add up to 0";
    ENDS_ENDLESS: "ends.endless", "line {line}, column {column}: the rule goes on for more than {most} times within one step";
    ENDS_SINGLE: "ends.single", "one module becomes more than {most} others at once";
    ENDS_READ: "ends.read", "the word is read as more than {most} modules";
    ENDS_NODES: "ends.nodes", "the word draws more than {most} internodes";
    ENDS_EXTENT: "ends.extent", "the wood reaches farther than {most} internodes; a smaller scale: shrinks it";
    ENDS_FULL: "ends.full", "the document would hold more internodes than it may, with those of earlier depths";
    ENDS_WORLD: "ends.world", "the wood would leave the world, which ends {most} internodes from its middle";
    ENDS_BROKEN: "ends.broken", "the wood of this step does not fit that of the one before";
    ENDS_COUNTED: "ends.counted", "what is deeper is too large to be counted";

    OPEN_SURFACE: "does-nothing.surface", "surfaces begin and end unequally often here: within one no wood is drawn"
        => "end each with its brace";
    TOO_SHALLOW: "does-nothing.stage", "`{name}` is read as it is: the homomorphism goes {depth} deep"
        => "write maximum depth: {deeper} below homomorphism:";
    NEVER_FIRES: "never-fires", "this rule never fires: that of line {line} takes every such module"
        => "put the rule with a condition or context first, or give both a probability";
    DOES_NOTHING: "does-nothing.module", "`{name}` is never rewritten and draws nothing";
    OLD_ELASTICITY: "does-nothing.elasticity", "`{name}` is never rewritten and draws nothing"
        => "the elasticity of wood is set with @Ts";
    NO_ANGLE: "no-angle", "it turns by {value} degrees, for no angle is set" => "write angle: 30";
    TINY_PIECES: "tiny-pieces", "at depth {depth} {count} of {all} lines are shorter than a quarter of an internode, and are joined with what follows"
        => "write scale: {scale}";

    LOST_ORGANS: "lost-organs", "at depth {depth} {count} leaves, flowers or fruits stand on no wood, or are more than {most} at one place: they are not drawn"
        => "draw wood before them";

    NOT_DRAWN_SURFACE: "not-drawn.surface", "`{name}` is a curved surface: is not drawn" => "write ~l for a leaf";
    SURFACE_AS_LEAF: "surface-as-leaf", "`{name}` is a surface of a file that is not here: a leaf stands for it"
        => "write ~f for a flower, ~k for a fruit";
    NOT_DRAWN_COLOUR: "not-drawn.colour", "`{name}` is another colour: wood has the colour of its bark";
    NOT_DRAWN_SOLID: "not-drawn.solid", "`{name}` is a circle or box: is not drawn";
    NOT_DRAWN_CYLINDER: "not-drawn.cylinder", "`{name}` shapes a cylinder: all wood is one skin";
    NOT_DRAWN_CONTOUR: "not-drawn.contour", "`{name}` is a contour: wood is round";
    NOT_DRAWN_LABEL: "not-drawn.label", "`{name}` is a label: is not drawn";
    NOT_DRAWN_SCREEN: "not-drawn.screen", "`{name}` is a command for a screen: is not obeyed";
    NOT_DRAWN_TROPISM: "not-drawn.tropism", "`{name}` changes how wood bends in a way that is not known here: it does not"
        => "the direction is set with @Tp, and how far with @Ts";
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn each_sentence_has_a_name_of_its_own() {
        let ids: BTreeSet<_> = WORDINGS.iter().map(|row| row.id).collect();
        assert_eq!(ids.len(), WORDINGS.len());
        for row in WORDINGS {
            let is_name =
                |name: &str| !name.is_empty() && name.bytes().all(|c| c == b'-' || c.is_ascii_lowercase());
            assert!(row.id.split('.').count() <= 2 && row.id.split('.').all(is_name), "{}", row.id);
            assert!(!row.message.ends_with('.'), "{}", row.id);
        }
    }

    #[test]
    fn values_stand_where_their_names_are() {
        let values = [("name", "{sign}".to_owned()), ("sign", "&&".to_owned())];
        assert_eq!(filled("`{name}`: write {sign} {or}", &values), "`{sign}`: write && {or}");
        assert_eq!(filled("{", &values), "{");
    }
}
