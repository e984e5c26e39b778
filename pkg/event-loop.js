/**
 * Lets the event loop take in what has arrived, and comes back without delay: timers would wait
 * for 4 ms or more when nested, and for a second in a page in the background.
 * @type {() => Promise<void>}
 */
export const yieldToEventLoop =
  typeof setImmediate === 'function'
    ? () => new Promise((resolve) => setImmediate(resolve))
    : throughChannel();

function throughChannel() {
  /** @type {(() => void)[]} */
  const waiting = [];
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => waiting.shift()?.();
  return () =>
    new Promise((/** @type {(value: void) => void} */ resolve) => {
      waiting.push(resolve);
      port2.postMessage(undefined);
    });
}
