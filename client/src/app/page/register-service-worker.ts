/** Has a service worker keep the page for when the server is away; on plain http elsewhere than here there is none. */
export function registerServiceWorker(): void {
  if (import.meta.env.PROD && "serviceWorker" in navigator) {
    addEventListener("load", () => {
      navigator.serviceWorker.register("/sw.js").catch((error: unknown) => console.warn("No service worker:", error));
    });
  }
}
