// Browsers start no workers of pages that are read from files. There the worker of the search runs in a hidden frame instead, so that
// the search needs neither a server nor a network.
if (location.protocol === "file:") {
  window.IFrameWorker = class extends EventTarget {
    constructor(script) {
      super()
      const frame = document.createElement("iframe")
      frame.hidden = true
      document.body.append(frame)
      const inside = frame.contentWindow
      // What the worker's script posts is for whoever listens here.
      inside.postMessage = data => this.dispatchEvent(new MessageEvent("message", { data }))
      const started = new Promise(resolve => {
        const element = inside.document.createElement("script")
        element.onload = resolve
        element.src = script
        inside.document.body.append(element)
      })
      this.postMessage = data => started.then(() => inside.dispatchEvent(new inside.MessageEvent("message", { data })))
      this.terminate = () => frame.remove()
    }
  }
  window.Worker = window.IFrameWorker
}
