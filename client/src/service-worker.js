// Keeps the page itself, so that it opens without the server and says so; never anything of the API.
// The build puts the version and the list of files in; what is kept under another version is dropped.

const KEPT = `espalier-${"VERSION"}`;
const SHELL = ["SHELL"];
/** A server that has not sent its page after so long is as good as away, in milliseconds. */
const PATIENCE = 3000;

self.addEventListener("install", (event) => {
  event.waitUntil(
    caches
      .open(KEPT)
      // What the browser holds already may be of another build.
      .then((cache) => cache.addAll(SHELL.map((path) => new Request(path, { cache: "reload" }))))
      .then(() => self.skipWaiting()),
  );
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    caches
      .keys()
      .then((names) => names.filter((name) => name.startsWith("espalier-") && name !== KEPT))
      .then((stale) => Promise.all(stale.map((name) => caches.delete(name))))
      .then(() => self.clients.claim()),
  );
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== "GET" || origin !== self.location.origin) {
    return;
  }
  if (request.mode === "navigate" && (pathname === "/" || pathname.startsWith("/s/"))) {
    event.respondWith(page(request));
  } else if (SHELL.includes(pathname)) {
    event.respondWith(kept(pathname).then((answer) => answer ?? fetch(request)));
  }
});

/** The server's own page, for it is never older than what is kept; else what is kept. */
function page(request) {
  const answer = fetch(request);
  const shell = new Promise((resolve) => setTimeout(resolve, PATIENCE)).then(() => kept("/"));
  return Promise.race([answer, shell.then((found) => found ?? answer)]).catch(() => kept("/"));
}

function kept(path) {
  return caches.open(KEPT).then((cache) => cache.match(path));
}
