/** Keeps the page for use without a network, and changes to a new version only as a whole. */
const { serviceWorker } = navigator;

/** @param {ServiceWorkerRegistration} registration */
function watch(registration) {
  const offer = () => {
    const { waiting } = registration;
    // The first one is no news.
    if (!waiting || !serviceWorker.controller) return;
    const button = document.createElement('button');
    button.className = 'primary renew';
    button.textContent = 'A new version is here: reload';
    button.addEventListener('click', () => waiting.postMessage('take over'));
    document.body.append(button);
  };
  offer();
  registration.addEventListener('updatefound', () => registration.installing?.addEventListener('statechange', offer));
}

if (serviceWorker) {
  const controlled = serviceWorker.controller !== null;
  // All tabs at once, for the files of the old version are gone; what they show stands in their address.
  serviceWorker.addEventListener('controllerchange', () => controlled && location.reload());
  // The page itself comes first.
  addEventListener('load', () => serviceWorker.register('./sw.js').then(watch, () => {}));
}
