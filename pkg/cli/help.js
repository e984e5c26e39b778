export const help = `\
Fits a piecewise-developable surface to a heightfield, with a certified bound of
how far from the optimum it can be.

Usage: developable fit INPUT -o OUTPUT [options]

  INPUT                  heights: a grey PNG (8 or 16 bit) or a 2D NumPy array
  -o, --output FILE      .npy or .png (heights at the input's pixels) or .obj
                         (a mesh); the file appears whole or not at all
  --lambda L             how closely to follow the input: small (1e5), medium
                         (1e6, the default), big (1e7) or any number above zero
  --gap G                certified relative gap to stop at (default 0.01)
  --schedule S           default, or paper: the published schedule, which stops
                         on residuals
  --max-iterations N     most iterations (default 20000)
  --lattice L            square (the default): INPUT is an image; hex: its
                         values are on the hexagonal lattice already (odd rows
                         half a spacing to the left, 0 or NaN is no data), and
                         so are those of OUTPUT
  --spacing S            distance of neighbours on the lattice (default: the
                         size of a pixel: 1 unless the file says otherwise)
  --height-scale S       factor from the file's values to heights (default: what
                         the file says; for a PNG that says nothing, white is a
                         quarter of the longer side above black; 1 for NPY)
  --mask FILE            PNG or NPY of the same shape; 0 takes a value out
  --no-data V            value that means no data, besides NaN
  --no-normalize         take the coordinates as they are, instead of scaling
                         them to the unit square, for which lambda is meant
  --report FILE          JSON file for the figures of the solve
  -h, --help             this text
  --version              the version

Exit status: 0 if all went well (also when --max-iterations ended the solve,
which is said on standard error), 2 for wrong usage, 3 if a file cannot be read,
used or written, 130 when interrupted.
`;
