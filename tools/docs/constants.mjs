/** A guess at whether a constant's name says what the constant is. */

/** Words that say neither a subject nor a quantity, or that any constant could have. */
const BARE = new Set(
  `ABOUT ABOVE ACROSS AFTER AGAIN ALIKE ALL ALONE ALONG ALREADY ANY APART AROUND AT AWAY BARELY BEFORE BEGIN BEGINNING BEHIND
   BELOW BESIDE BEST BETTER BETWEEN BEYOND BIG BITS BOTH BRIEF CERTAIN CHEAP CLEAR CLEARLY CLOSE COARSE DEEP DOWN EACH EARLY EASY
   ENOUGH EVEN EVER EVERY FAINT FAIR FAR FAST FEW FEWEST FINE FINER FIRM FIRST FIT FOLLOWING FULL GOOD GREAT HARD HARDLY HIGH HOLD
   HOLDS IN INNER LARGE LARGEST LAST LATE LEAST LESS LIKELY LITTLE LONG LOOK LOOKS LOOSE LOUD LOW MANY MIN MAX MORE MOST MUCH NEAR
   NEARLY NEGLIGIBLE NEW NONE NOT NOTHING NOWHERE OF OFF OFTEN ON ONCE ONE ONLY OUT OUTER OVER OWN PART PLAIN PLENTY QUICK RARE
   RARELY REACH ROUGH ROUND SAFE SAFETY SAME SEEN SETTLING SEVERAL SHARP SHORT SIDE SINGLE SLIGHT SLIGHTLY SMALL SMALLEST SOME
   SOON SPECK SPITE START STEP STEPS STEADY STILL STRONG SURE THIN TIMES TINY TO TOGETHER TOO TRIES UNDER UP USUAL VERY WEAK WELL
   WHOLE WIDE WITH WITHIN WORTH`.split(/\s+/),
);

/** Single words that are the field's own name of one number or one thing. */
const TERMS = new Set(
  `AXES EPSILON GOLDEN_RATIO PHI PI TAU`.split(/\s+/),
);

/**
 * Whether a name is one word, or bare words alone. A constant that belongs to a type has that as its subject.
 * @param {string} qualified
 */
export function isVague(qualified) {
  const [name, ...types] = qualified.split('::').reverse();
  if (TERMS.has(name)) return false;
  const words = name.split('_').filter((word) => word !== '');
  const told = words.filter((word) => !BARE.has(word));
  return told.length === 0 || (words.length === 1 && types.length === 0);
}
