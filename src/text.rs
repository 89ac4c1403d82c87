//! What `barrier-check explain` and the reference tell of a check, a load case or a warning; it is written where the thing itself is.

/// The text of a check, a load case or a warning as it is written down.
pub struct Text {
    /// As in `result.json`; `N` stands for a number that is counted from 1.
    pub id: &'static str,
    pub meaning: &'static str,
    /// What is compared or computed; empty where there is none.
    pub formula: &'static str,
    /// Empty where it rests on the design alone.
    pub source: &'static str,
}
