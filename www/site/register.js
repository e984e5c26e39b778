/** Registers the service worker, which keeps the page for use without a network, and offers new versions. */
const { serviceWorker } = navigator;

/** Offers a new version when it is installed. @param {ServiceWorkerRegistration} registration */
function watch(registration) {
  const offer = () => {
    const { waiting } = registration;
    // The first installation is not an update.
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
  // All tabs reload, because the files of the old version are deleted; the address keeps their state.
  serviceWorker.addEventListener('controllerchange', () => controlled && location.reload());
  // Registration waits until the page is loaded.
  addEventListener('load', () => serviceWorker.register('./sw.js').then(watch, () => {}));
}
