//! How far a call is that takes long: told to a function that listens on the caller's thread.
//!
//! ```
//! use developable::{Heightfield, Lattice, progress, unroll::{UnrollOptions, unroll}};
//! # fn main() -> developable::Result<()> {
//! let bent = Heightfield::from_fn(Lattice::new(40, 40, 0.025)?, |x, _| x * x)?;
//! progress::listen(Some(Box::new(|fraction| println!("{:.0} %", 100.0 * fraction))));
//! let sheet = unroll(&bent, &UnrollOptions::default())?;
//! progress::listen(None);
//! # assert!(sheet.report().iterations > 0);
//! # Ok(())
//! # }
//! ```

use std::cell::{Cell, RefCell};

/// Function that is called with the fraction of a call's work that is done, from 0 to 1.
pub type Listener = Box<dyn FnMut(f64)>;

thread_local! {
    static LISTENER: RefCell<Option<Listener>> = const { RefCell::new(None) };
    /// The part of the whole work that runs now: where it begins and ends, as fractions of the whole.
    static SPAN: Cell<[f64; 2]> = const { Cell::new([0.0, 1.0]) };
    /// The fraction of the whole work that was told last.
    static TOLD: Cell<f64> = const { Cell::new(0.0) };
}

/// Sets the function that hears how far the next call on this thread is that lays surfaces flat, makes a pattern or finds the
/// sheet of a page; `None` for none. The fractions never fall; they are estimates, so that the pace varies.
pub fn listen(listener: Option<Listener>) {
    LISTENER.set(listener);
    SPAN.set([0.0, 1.0]);
    TOLD.set(0.0);
}

/// Runs a part of the present work, which lasts until the fraction `end` of that is done.
pub fn part<T>(end: f64, work: impl FnOnce() -> T) -> T {
    let span = SPAN.get();
    let inner = [TOLD.get(), within(span, end)];
    SPAN.set([inner[0], inner[1].max(inner[0])]);
    let result = work();
    SPAN.set(span);
    reach(end);
    result
}

/// Tells that a fraction of the present work is done.
pub(crate) fn reach(fraction: f64) {
    let reached = within(SPAN.get(), fraction);
    if reached > TOLD.get() {
        TOLD.set(reached);
        // The function may set another one.
        if let Some(mut listener) = LISTENER.take() {
            listener(reached);
            LISTENER.with_borrow_mut(|own| {
                own.get_or_insert(listener);
            });
        }
    }
}

fn within([begin, end]: [f64; 2], fraction: f64) -> f64 {
    begin + (end - begin) * fraction.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::rc::Rc;

    #[test]
    fn fractions_of_parts_within_parts_rise_to_those_of_the_whole() {
        let told = Rc::new(RefCell::new(Vec::new()));
        let heard = told.clone();
        listen(Some(Box::new(move |fraction| {
            heard.borrow_mut().push(fraction)
        })));
        part(0.5, || {
            reach(0.5);
            // What is told again, or less of it, is not told.
            reach(0.25);
            part(0.75, || reach(0.5));
        });
        reach(f64::NAN);
        reach(2.0);
        listen(None);
        part(1.0, || reach(0.5));
        assert_eq!(*told.borrow(), [0.25, 0.3125, 0.375, 0.5, 1.0]);
    }
}
