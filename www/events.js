/** Who is told of what, by the names of what happens. @template E */
export class Events {
  /** @type {{ [K in keyof E]?: ((value: E[K]) => void)[] }} */
  #listeners = {};

  /**
   * @template {keyof E} K
   * @param {K} event
   * @param {(value: E[K]) => void} listener
   */
  on(event, listener) {
    const listeners = (this.#listeners[event] ??= []);
    listeners.push(listener);
  }

  /**
   * For the one whose events they are.
   * @protected
   * @template {keyof E} K
   * @param {K} event
   * @param {E[K]} value
   */
  emit(event, value) {
    for (const listener of this.#listeners[event] ?? []) listener(value);
  }
}
