// Browsers start no Worker for a page that was opened from the disk. The search, the only one here, then runs in a frame.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(script) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      window.answerOfWorker = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      const answers = "<script>self.postMessage = (data) => parent.answerOfWorker(data)</" + "script>";
      const program = `<script src="${new URL(script, location.href)}"></` + "script>";
      this.ready = new Promise((resolve) => frame.addEventListener("load", () => resolve(frame.contentWindow)));
      frame.srcdoc = answers + program;
      document.body.append(frame);
    }
    postMessage(data) {
      this.ready.then((frame) => frame.dispatchEvent(new MessageEvent("message", { data })));
    }
  };
}
