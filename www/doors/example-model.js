/** The model behind the door "Cut a model": a house of 48 × 64 mm, whose sheet fits a page of A4 or Letter. */

/** Half the width, half the depth, the height of the walls and that of the ridge, in millimetres. */
const [HALF_WIDTH, HALF_DEPTH, WALL_HEIGHT, RIDGE_HEIGHT] = [24, 32, 36, 64];

/** Whether a file is the example, which was written at no time. @param {File} file */
export const isExampleModel = ({ name, lastModified }) => name === 'house.obj' && lastModified === 0;

/** The house as a Wavefront OBJ, with y upwards, which the page opens as any other file. */
export function exampleModel() {
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => [x * HALF_WIDTH, y * HALF_DEPTH]);
  const vertices = [
    ...[0, WALL_HEIGHT].flatMap((z) => corners.map(([x, y]) => [x, z, -y])),
    [0, RIDGE_HEIGHT, HALF_DEPTH], [0, RIDGE_HEIGHT, -HALF_DEPTH],
  ];
  const faces = ['4 3 2 1', '1 2 6 9 5', '3 4 8 10 7', '2 3 7 6', '4 1 5 8', '6 7 10 9', '8 5 9 10'];
  const lines = [...vertices.map((vertex) => `v ${vertex.join(' ')}`), ...faces.map((face) => `f ${face}`)];
  return new File([`${lines.join('\n')}\n`], 'house.obj', { lastModified: 0 });
}
