/** Names that options may have as their values. Made of the enumerations in `src/` by `tools/types`. */

export const Energy = ['nuclear', 'frobenius', 'squaredNuclear', 'secondFormOfInput', 'secondForm', 'huber'];

export const Format = ['png', 'npy', 'tiff', 'exr', 'pfm', 'npz', 'jpeg', 'webp', 'text', 'colmap', 'gif', 'bmp', 'pgm', 'hgt'];

export const LightTreatment = ['even', 'keep'];

export const Unit = ['mm', 'm'];
