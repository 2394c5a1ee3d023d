//! Rewriting as the textbooks define it: strings of characters, contexts of one symbol, no parameters.

/// A rule: what must stand to the left, the symbol, what must stand to the right, and what it becomes.
#[derive(Clone, Debug)]
pub struct Rule {
    pub left: Option<char>,
    pub symbol: char,
    pub right: Option<char>,
    pub successor: String,
}

/// A system without parameters.
#[derive(Clone, Debug, Default)]
pub struct System {
    pub axiom: String,
    pub ignored: String,
    pub rules: Vec<Rule>,
}

impl System {
    /// The string after so many steps.
    pub fn derive(&self, depth: usize) -> String {
        (0..depth).fold(self.axiom.clone(), |word, _| self.step(&word.chars().collect::<Vec<_>>()))
    }

    fn step(&self, word: &[char]) -> String {
        let rewritten = |at: usize| {
            let fits = |rule: &&Rule| {
                rule.symbol == word[at]
                    && rule.left.is_none_or(|left| self.below(word, at) == Some(left))
                    && rule.right.is_none_or(|right| self.above(word, at) == Some(right))
            };
            match self.rules.iter().find(fits) {
                Some(rule) => rule.successor.clone(),
                None => word[at].to_string(),
            }
        };
        (0..word.len()).map(rewritten).collect()
    }

    /// The nearest symbol that counts on the way to the root.
    fn below(&self, word: &[char], at: usize) -> Option<char> {
        let mut closed = 0;
        for &c in word[..at].iter().rev() {
            match c {
                ']' => closed += 1,
                '[' if closed > 0 => closed -= 1,
                '[' => {}
                c if closed == 0 && !self.ignored.contains(c) => return Some(c),
                _ => {}
            }
        }
        None
    }

    /// The next symbol that counts on the same axis.
    fn above(&self, word: &[char], at: usize) -> Option<char> {
        let mut open = 0;
        for &c in &word[at + 1..] {
            match c {
                '[' => open += 1,
                ']' if open == 0 => return None,
                ']' => open -= 1,
                c if open == 0 && !self.ignored.contains(c) => return Some(c),
                _ => {}
            }
        }
        None
    }

    /// The same as a grammar's text.
    pub fn text(&self) -> String {
        let mut text = format!("axiom: {}\nangle: 30\n", self.axiom);
        if !self.ignored.is_empty() {
            text.push_str(&format!("ignore: {}\n", self.ignored));
        }
        for Rule { left, symbol, right, successor } in &self.rules {
            let left = left.map(|left| format!("{left} < ")).unwrap_or_default();
            let right = right.map(|right| format!(" > {right}")).unwrap_or_default();
            let successor = if successor.is_empty() { "*" } else { successor };
            text.push_str(&format!("{left}{symbol}{right} --> {successor}\n"));
        }
        text
    }
}
