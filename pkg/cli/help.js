export const help = `\
Fits a piecewise-developable surface to a heightfield, with a certified bound of
how far from the optimum it can be.

Usage: developable fit INPUT -o OUTPUT [options]
       developable design CONSTRAINTS -o OUTPUT [options]
       developable occlusions INPUT -o MASK [options]
       developable analyze INPUT -o FIGURES [options]
       developable unroll INPUT -o SHEET [options]
       developable pattern INPUT -o PATTERN [options]
       developable dewarp INPUT --texture PHOTO -o IMAGE [options]
       developable info FILE [--array NAME]

"fit" follows heights, "design" passes through heights and is free elsewhere,
"occlusions" looks for places where a surface is torn, and prints how many
vertices it has found. Four commands fit a surface first: "analyze" tells how
developable it is, beside the input, "unroll" lays it flat, "pattern" cuts it
along its creases into sheets to be made of paper or metal, and "dewarp" makes a
photo of it flat. "info" tells what is in a file, of either kind.

  INPUT                  heights: TIFF, EXR, PFM, NPY or NPZ, or a grey picture
                         (PNG, JPEG, WebP); or a mesh or point cloud, of which
                         what is seen from one side is taken: .obj, .ply, .stl,
                         .glb, .gltf. Materials, textures and buffers that it
                         names are read from its folder or below; what is not
                         there is warned of
  CONSTRAINTS            heights likewise; transparent pixels and NaN are free
  -o, --output FILE      .npy, .png, .tif or .exr (heights at the input's
                         pixels) or .obj, .ply, .stl or .glb (a mesh); the file
                         appears whole or not at all. Of a mesh, the latter are
                         in its own coordinates, with its colours and texture
                         coordinates, the former heights on the lattice
  MASK                   .png or .npy, white (or 1) where the surface is torn
  FIGURES                .json
  SHEET                  .obj (a flat mesh) or .json (with stretch and overlaps)
  PATTERN                .svg, .pdf or .dxf in true size, or .json
  IMAGE                  .png, transparent where there is no sheet

What to minimise
  --lambda L             how closely to follow the input: small (1e5), medium
                         (1e6, the default), big (1e7) or any number above zero
  --energy E             nuclear (the default), frobenius, squaredNuclear,
                         secondFormOfInput or secondForm
  --reweight N           passes that undo the shrinking of curvature; 2 or 3 are
                         usual (default 0)
  --tie-break E          weight that keeps free vertices near a thin plate
                         (default 0.01)
  --no-normalize         take the coordinates as they are, instead of scaling
                         them to the unit square, for which lambda is meant

When to stop
  --gap G                certified relative gap to stop at (default 0.01)
  --schedule S           default, or paper: the published schedule, which stops
                         on residuals
  --max-iterations N     most iterations (default 20000)

How to read the heights
  --lattice L            square (the default): INPUT is an image; hex: its
                         values are on the hexagonal lattice already (odd rows
                         half a spacing to the left, 0 or NaN is no data), and
                         so are those of OUTPUT
  --spacing S            distance of neighbours on the lattice (default: the
                         size of a pixel: 1 unless the file says otherwise)
  --height-scale S       factor from the file's values to heights (default: what
                         the file says, 1 for floats, NPY and NPZ; for other
                         whole numbers white is a quarter of the longer side
                         above black)
  --array NAME           the array of an NPZ file, where it holds several
  --mask FILE            image of the same shape; 0 takes a value out
  --no-data V            value that means no data, besides NaN

Colours of OUTPUT
  --texture FILE         PNG, JPEG or WebP picture with the outline of INPUT, or
                         that its texture coordinates are about: the colours of
                         an .obj or .ply, the texture of a .glb (of a WebP its
                         colours alone). A mesh with textures of its own does
                         not need it
  --mtl FILE             .mtl file to be written, too, through which an .obj has
                         that picture as its texture

How to look at a mesh
  --intrinsics fx,fy,cx,cy[,scale]
                         INPUT holds the depths that a camera with these numbers
                         (in pixels; the centre of the top left one is 0,0) has
                         seen; 0 and below are none. It is taken for a mesh, in
                         which jumps are not bridged; scale makes lengths of
                         depths. x is to the right, y up, the axis along -z
  --ray                  depths are from the camera, not along its axis
  --view V               the direction to look in: -x, +x, -y, +y, -z (the
                         default: what has the largest z is in front), +z, a
                         vector as 0,-1,-1, or best-fit: straight at the plane
                         that fits best. Up is near +y (along -y it is -z)
  --resolution N         vertices along the longer side (default 200; of a point
                         cloud fewer, to leave each some points)
  --spacing S            their distance instead, in the mesh's unit

What else is known (files of the same shape)
  --confidence FILE      how far each height is to be trusted: whole numbers as
                         shares of their largest, so that white is 1 and black
                         0; others as they are
  --constraints FILE     heights to be met exactly, in the input's scale;
                         transparent pixels and NaN are free
  --free V               value of the constraints that means free, besides
  --occlusion-mask FILE  not 0 where the surface is torn
  --occlusions T         look for more such places: where it bends by more than
                         T; auto is the authors' value, 4e4
  --threshold T          the same for "occlusions" (default 4e4)

Flat sheets and images
  --as-is                take the heights as they are, without a fit
  --texture PHOTO        a PNG, JPEG or WebP of what the heights show, with as
                         many pixels as it likes
  --dots D               pixels of the flat image per unit of length (default:
                         as many as the photo has)
  --trim                 cut off the margins where there is no sheet
  --map FILE             .npy (height, width, 2) or .json: for each pixel of the
                         flat image its place x, y in the photo
  --scale MM             millimetres of the pattern for each unit of length
                         (default 1)
  --tabs MM              depth of tabs to glue along creases that are cut
                         (default: none)
  --paper P              a4 or letter: a .pdf on pages that are put together by
                         the crosses on them; none (the default): on one page
  --threshold K          Gaussian curvature that counts for "analyze"
                         (default 1)

  --report FILE          JSON file for the figures of the solve, the sheet or
                         the pattern
  -h, --help             this text
  --version              the version

Exit status: 0 if all went well (also when --max-iterations ended the solve,
which is said on standard error), 2 for wrong usage, 3 if a file cannot be read,
used or written, 130 when interrupted.
`;
