/** Event emitter whose type parameter maps names of events to their values. @template E */
export class Events {
  /** @type {{ [K in keyof E]?: ((value: E[K]) => void)[] }} */
  #listeners = {};

  /** Adds a listener to an event. @template {keyof E} K @param {K} event @param {(value: E[K]) => void} listener */
  on(event, listener) {
    (this.#listeners[event] ??= []).push(listener);
  }

  /** Resolves with the next of some events. @param {...keyof E} events */
  next(...events) {
    return new Promise((resolve) => events.forEach((event) => this.on(event, resolve)));
  }

  /** Calls the listeners of an event; for subclasses. @protected @template {keyof E} K @param {K} event @param {E[K]} value */
  emit(event, value) {
    for (const listener of this.#listeners[event] ?? []) listener(value);
  }
}
