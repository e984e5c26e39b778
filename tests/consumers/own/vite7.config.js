/** The setting that Vite before version 8 needs for workers of one's own, as the README has it. */
export default { worker: { format: 'es' } };
