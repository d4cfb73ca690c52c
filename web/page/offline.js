// Keeps what was loaded once, so that the page opens without a network; what is newer wins.
const store = 'plexway';
self.addEventListener('install', () => self.skipWaiting());
self.addEventListener('activate', (event) => event.waitUntil(self.clients.claim()));
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET') return;
  event.respondWith(
    fetch(event.request).then((answer) => {
      const copy = answer.clone();
      if (answer.ok) caches.open(store).then((kept) => kept.put(event.request, copy));
      return answer;
    }).catch(() => caches.match(event.request, { ignoreSearch: true })
      .then((kept) => kept ?? Response.error())));
});
