/** Registers the service worker, which keeps the page for use without a network, and offers new versions. */
const { serviceWorker } = navigator;

/** Offers a new version when it is installed. @param {ServiceWorkerRegistration} registration */
function watch(registration) {
  const offer = () => {
    // The first installation is not an update.
    if (!registration.waiting || !serviceWorker.controller || document.querySelector('.renew')) return;
    const button = document.createElement('button');
    button.className = 'primary renew';
    button.textContent = 'A new version is here: reload';
    button.addEventListener('click', () => registration.waiting?.postMessage('take over'));
    document.body.append(button);
  };
  offer();
  registration.addEventListener('updatefound', () => registration.installing?.addEventListener('statechange', offer));
}

if (serviceWorker) {
  // The address keeps what is shown.
  serviceWorker.addEventListener('message', ({ data }) => data === 'renewed' && location.reload());
  // Registration waits until the page is loaded.
  addEventListener('load', () => serviceWorker.register('./sw.js').then(watch, () => {}));
}
