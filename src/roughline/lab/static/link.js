// The websocket to the server: questions go out, answers come back to who asked.
const LATER = 1500; // until it is tried again [ms]

export class Link {
  #socket; #waiting = new Map(); #number = 0; #told; #queue = [];
  session = null;

  // told(isOpen, isNew) says whether the page is connected, and whether its session is a new one.
  constructor(told) {
    this.#told = told;
    this.#open();
  }

  // Ask for a task. A newer question with the same slot takes the place of an older one.
  ask(task, slot, args, {answer, error, progress}) {
    const id = ++this.#number;
    for (const [old, asked] of this.#waiting) {
      if (asked.slot === slot && asked.replaced) this.#waiting.delete(old);
      else if (asked.slot === slot) asked.replaced = true;
    }
    this.#waiting.set(id, {slot, answer, error, progress});
    this.#send({id, slot, task, arguments: args});
    return id;
  }

  // Stop what was asked for a slot.
  stop(slot) {
    let asked = false;
    for (const [id, each] of this.#waiting) {
      if (each.slot === slot) { this.#waiting.delete(id); asked = true; }
    }
    if (asked) this.#send({slot, stop: true});
  }

  isWaiting(slot) {
    return [...this.#waiting.values()].some((each) => each.slot === slot && !each.replaced);
  }

  #send(message) {
    const text = JSON.stringify(message);
    if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send(text);
    else this.#queue.push(text);
  }

  #open() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    this.#socket = new WebSocket(`${scheme}//${location.host}/link`);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onmessage = ({data}) => (typeof data === "string" ? this.#said(JSON.parse(data)) : this.#answered(data));
    this.#socket.onclose = (event) => {
      const lost = [...this.#waiting.values()];
      this.#waiting.clear();
      this.#queue = [];
      this.#told(false, false, event.reason);
      for (const each of lost) each.error?.("the connection was lost: ask again when it is back", "");
      setTimeout(() => this.#open(), LATER);
    };
  }

  #said(message) {
    if (message.session) {
      const again = this.session !== null;
      this.session = message.session;
      for (const text of this.#queue.splice(0)) this.#socket.send(text);
      this.#told(true, again, "");
      return;
    }
    const asked = this.#waiting.get(message.id);
    if (!asked) return;
    if ("error" in message) {
      this.#waiting.delete(message.id);
      asked.error?.(message.error, message.at);
    } else {
      asked.progress?.(message);
    }
  }

  #answered(buffer) {
    const id = Number(new DataView(buffer).getBigUint64(0, true));
    const asked = this.#waiting.get(id);
    if (!asked) return;
    this.#waiting.delete(id);
    asked.answer(unpacked(buffer, 8));
  }
}

const TYPES = {float32: Float32Array, uint8: Uint8Array, uint32: Uint32Array};

// A message of the server: its header, with the arrays in it as {values, shape, dtype}.
export function unpacked(buffer, start = 0) {
  const length = new DataView(buffer).getUint32(start, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, start + 4, length)));
  const data = start + 4 + length;
  for (const [name, {dtype, shape, offset}] of Object.entries(header.arrays)) {
    const count = shape.reduce((product, n) => product * n, 1);
    header.arrays[name] = {dtype, shape, values: new TYPES[dtype](buffer, data + offset, count)};
  }
  return header;
}
