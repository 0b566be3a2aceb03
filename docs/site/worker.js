// Browsers start no worker for a page that is opened as a file. There the search runs in a hidden frame.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.append(this.frame);
      const inner = this.frame.contentWindow;
      inner.postMessage = (data) => setTimeout(() => this.tell(new MessageEvent("message", { data })));
      const script = inner.document.createElement("script");
      this.loaded = new Promise((loaded) => { script.onload = loaded; });
      script.onerror = () => this.tell(new ErrorEvent("error", { message: `${url} cannot be read` }));
      script.src = new URL(url, location.href).href;
      inner.document.body.append(script);
    }

    tell(event) {
      this.dispatchEvent(event);
      this[`on${event.type}`]?.(event);
    }

    postMessage(data) {
      this.loaded.then(() => this.frame.contentWindow?.dispatchEvent(new MessageEvent("message", { data })));
    }

    terminate() {
      this.frame.remove();
    }
  };
}
