/** Registers the service worker, which keeps the page for use without a network, and offers new versions. */
const { serviceWorker } = navigator;
/** The page while something is being opened or solved. */
const BUSY = 'main:is([data-phase="starting"], [data-phase="running"], [data-opening]), main [aria-busy="true"]';
const changes = new MutationObserver(registerWhenIdle);
let isRegistered = false;

/** Registers the worker when the page has nothing to do: the files that it fetches would delay an answer. */
function registerWhenIdle() {
  // A solve follows an opening at once.
  setTimeout(() => {
    if (isRegistered || document.querySelector(BUSY)) return;
    isRegistered = true;
    changes.disconnect();
    serviceWorker.register('./sw.js').then(watch, () => {});
  });
}

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
  changes.observe(document.body, { subtree: true, attributeFilter: ['data-phase', 'data-opening', 'aria-busy'] });
  registerWhenIdle();
}
