/** Values that nobody should pass, and some that look odd but are in order. */

const boom = () => {
  throw new RangeError('boom');
};

/** A view whose buffer was handed over. @param {ArrayBufferView & { buffer: ArrayBufferLike }} view */
function detached(view) {
  structuredClone(view.buffer, { transfer: [/** @type {ArrayBuffer} */ (view.buffer)] });
  return view;
}

/** A buffer that may grow to twice its size. @param {number} length @returns {ArrayBuffer} */
export const resizableBuffer = (length) => Reflect.construct(ArrayBuffer, [length, { maxByteLength: 2 * length }]);

/** A view of the second half of a buffer that was made smaller. */
function outOfBounds() {
  const buffer = resizableBuffer(64);
  const view = new Float64Array(buffer, 32, 4);
  /** @type {any} */ (buffer).resize?.(8);
  return view;
}

/** An object that throws whatever is done to it. */
function mined() {
  /** @type {Record<string, () => never>} */
  const handler = {};
  for (const trap of Object.getOwnPropertyNames(Reflect)) handler[trap] = boom;
  return new Proxy({}, handler);
}

function revoked() {
  const { proxy, revoke } = Proxy.revocable([], {});
  revoke();
  return proxy;
}

/** A circle of objects. */
function endless() {
  /** @type {Record<string, unknown>} */
  const value = {};
  value.self = value;
  return value;
}

/** @param {number} length what it claims to be */
const liar = (length) => Object.defineProperty(new Float64Array(4), 'length', { get: () => length });

/** Each value freshly made, with its name. @returns {[string, unknown][]} */
export function hostileValues() {
  return Object.entries({
    null: null,
    true: true,
    minusOne: -1,
    zero: 0,
    minusZero: -0,
    half: 0.5,
    NaN,
    infinity: Infinity,
    minusInfinity: -Infinity,
    tiny: 5e-324,
    huge: 1e308,
    int32: 2 ** 31,
    uint32: 2 ** 32,
    beyond: 2 ** 53,
    empty: '',
    text: 'x',
    lone: '\ud800',
    proto: '__proto__',
    long: 'a'.repeat(100_000),
    bigint: 10n,
    symbol: Symbol('s'),
    function: () => 1,
    class: class {},
    list: [],
    pair: [0, 1],
    longAndThin: [1e300, 1e-300],
    noArea: [0, 0, 0, 0],
    nested: [[1, 2], [3]],
    sparse: [1, , 3], // eslint-disable-line no-sparse-arrays
    mixed: [1, '2', null],
    object: {},
    bare: Object.create(null),
    mined: mined(),
    minedList: new Proxy([1, 2, 3], { get: boom }),
    longList: new Proxy([], { get: (_, name) => (name === 'length' ? 2 ** 40 : 0) }),
    revoked: revoked(),
    getter: { get width() { return boom(); }, get length() { return boom(); }, get data() { return boom(); } },
    primitive: { [Symbol.toPrimitive]: boom, toString: boom, valueOf: boom, toJSON: boom },
    iterator: { [Symbol.iterator]: boom },
    thenable: { get then() { return boom(); } },
    tagged: { get [Symbol.toStringTag]() { return boom(); } },
    endless: endless(),
    date: new Date(NaN),
    map: new Map([['a', 1]]),
    buffer: new ArrayBuffer(8),
    detachedBuffer: (() => { const bytes = new Uint8Array(8); detached(bytes); return bytes.buffer; })(),
    shared: new SharedArrayBuffer(8),
    dataView: new DataView(new ArrayBuffer(8)),
    detachedDataView: detached(new DataView(new ArrayBuffer(8))),
    bigints: new BigInt64Array(4),
    short: new Float64Array(3),
    sharedView: new Float64Array(new SharedArrayBuffer(8 * 64)),
    resizable: new Float64Array(resizableBuffer(8 * 64)),
    outOfBounds: outOfBounds(),
    detachedFloats: detached(new Float64Array(64)),
    detachedBytes: detached(new Uint8Array(64)),
    detachedInts: detached(new Int16Array(64)),
    liar: liar(2 ** 40),
    minedArray: Object.defineProperty(new Float64Array(4), 'length', { get: boom }),
    proxiedArray: new Proxy(new Float64Array(64), {}),
    proxiedBytes: new Proxy(new Uint8Array(64), {}),
    fakeSignal: { aborted: false, throwIfAborted() {}, addEventListener: boom, removeEventListener() {} },
  });
}

/** @template {object} T @param {T} object @param {string} name @param {() => unknown} get @returns {T} */
export const withGetter = (object, name, get) =>
  Object.defineProperty({ ...object }, name, { get, enumerable: true, configurable: true });

export { boom };
