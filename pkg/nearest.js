/** What somebody may have meant who wrote a name that there is not. */

/**
 * A sentence about a name that there is not: with the nearest one that there is, or with all of them.
 * @param {string} what it is, as in `option`
 * @param {string} name
 * @param {readonly string[]} known
 */
export function unknownName(what, name, known) {
  const near = nearest(name, known);
  return near === undefined
    ? `unknown ${what} \`${name.slice(0, 40)}\`: there ${known.length === 1 ? 'is' : 'are'} only ${known.join(', ')}`
    : `unknown ${what} \`${name}\`: did you mean \`${near}\`?`;
}

/**
 * The known name that a few slips of the keyboard turn into the given one.
 * @param {string} name
 * @param {readonly string[]} known
 */
export function nearest(name, known) {
  // A name of that length is no slip, and comparing takes as many steps as both have letters.
  if (name.length > 40) return undefined;
  const [best] = known
    .map((candidate) => ({ candidate, slips: slips(name.toLowerCase(), candidate.toLowerCase()) }))
    .filter(({ candidate, slips }) => slips <= Math.max(1, Math.floor(candidate.length / 3)))
    .sort((a, b) => a.slips - b.slips);
  return best?.candidate;
}

/**
 * The Damerau–Levenshtein distance (its restricted form): letters left out, added, changed, or swapped with the next.
 * @param {string} a
 * @param {string} b
 */
function slips(a, b) {
  /** @type {number[][]} distances of the first letters of `a`, a row each, from the first letters of `b` */
  const table = [Array.from({ length: b.length + 1 }, (_, j) => j)];
  for (let i = 1; i <= a.length; i += 1) {
    const row = [i];
    for (let j = 1; j <= b.length; j += 1) {
      const changed = table[i - 1][j - 1] + Number(a[i - 1] !== b[j - 1]);
      row[j] = Math.min(table[i - 1][j] + 1, row[j - 1] + 1, changed);
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) {
        row[j] = Math.min(row[j], table[i - 2][j - 2] + 1);
      }
    }
    table.push(row);
  }
  return table[a.length][b.length];
}
