// The websocket to the server: questions go out, answers come back to who asked. When it drops it is
// opened again, the session goes on, and what still waits is asked again.
import {recall, remember} from "./remember.js";

const SOON = 1500, LATER = 15_000; // until it is tried again, at first and at most [ms]
const PATIENCE = 10_000; // with a server that does not say whether it is there [ms]
const ELSEWHERE = 4001; // another tab, made as a copy of this one, goes on with the session
const REFUSED = 1009; // what the page said was too much

export class Link {
  #socket = null; #waiting = new Map(); #number = 0; #told; #opened;
  #unsaid = new Map(); // by their slots, what is told as soon as the page is connected again
  #delay = SOON; #timer = null; #isElsewhere = false;
  session = null;

  // Resolves when the page is connected first, to {resumed, files}: whether its session is the one
  // that it had before it was loaded again, and names and digests of the files in it by their keys.
  ready = new Promise((resolve) => { this.#opened = resolve; });

  // told.open({isAgain, resumed, files, isElsewhere, version}) when the page is connected, and
  // told.closed(reason, isUnknown) when it is not.
  constructor(told) {
    this.#told = told;
    this.#open();
    addEventListener("online", () => this.#tryNow());
    document.addEventListener("visibilitychange", () => { if (!document.hidden) this.#tryNow(); });
  }

  // Ask for a task. A newer question with the same slot takes the place of an older one, unless that is being answered:
  // of a slider that moves faster than answers come, these are what is seen.
  ask(task, slot, args, {answer, error, progress}) {
    const id = ++this.#number;
    for (const asked of this.#waiting.values()) if (asked.slot === slot) asked.replaced = true;
    const message = {id, slot, task, arguments: args};
    this.#waiting.set(id, {slot, message, answer, error, progress});
    this.#unsaid.delete(slot);
    this.#send(message);
    return id;
  }

  // Stop what was asked for a slot.
  stop(slot) {
    let asked = false;
    for (const [id, each] of this.#waiting) {
      if (each.slot === slot) { this.#waiting.delete(id); asked = true; }
    }
    if (asked) this.#tell({slot, stop: true});
  }

  // Delete the files of the page, and what was made of them; tells whether that is done at once.
  forgetFiles() { return this.#tell({slot: "files", forget: true}); }

  isWaiting(slot) {
    return [...this.#waiting.values()].some((each) => each.slot === slot && !each.replaced);
  }

  // Tell the server now, or else as soon as the page is connected; tells whether it was now.
  #tell(message) {
    const isSent = this.#send(message);
    if (!isSent) this.#unsaid.set(message.slot, message);
    return isSent;
  }

  // Send a message if the page is connected; what is asked is asked again when it is.
  #send(message) {
    const isOpen = this.#socket?.readyState === WebSocket.OPEN && this.session !== null;
    if (isOpen) this.#socket.send(JSON.stringify(message));
    return isOpen;
  }

  #open() {
    const address = new URL(`link?${new URLSearchParams({session: recall("session") ?? ""})}`, document.baseURI);
    address.protocol = address.protocol.replace("http", "ws");
    this.#socket = new WebSocket(address);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onmessage = ({data}) => (typeof data === "string" ? this.#said(JSON.parse(data)) : this.#answered(data));
    this.#socket.onclose = (event) => this.#closed(event);
  }

  #closed({code, reason}) {
    if (code === ELSEWHERE) {
      remember("session", null);
      this.#isElsewhere = true;
      this.#open();
      return;
    }
    this.#told.closed(reason, false);
    if (code === REFUSED) {
      const lost = this.#waiting;
      this.#waiting = new Map();
      for (const each of lost.values()) each.error?.("the lab refused the connection: ask again when it is back", "");
    }
    this.#tryLater();
  }

  #tryLater() {
    this.#timer = setTimeout(() => this.#again(), this.#delay);
    this.#delay = Math.min(LATER, 1.6 * this.#delay);
  }

  #tryNow() {
    if (this.#timer === null) return;
    clearTimeout(this.#timer);
    this.#delay = SOON;
    this.#again();
  }

  // Open it again if the server is there and knows this browser, which a websocket cannot tell.
  async #again() {
    this.#timer = null;
    const said = await fetch("here", {cache: "no-store", signal: AbortSignal.timeout(PATIENCE)})
      .then((reply) => reply.text(), () => "");
    if (said === "known") { this.#open(); return; }
    this.#told.closed("", said === "unknown");
    this.#tryLater();
  }

  #said(message) {
    if (message.session) this.#connected(message);
    else if ("error" in message) this.#ended(message.id)?.error?.(message.error, message.at);
    else this.#waiting.get(message.id)?.progress?.(message);
  }

  // What was asked by a number, which waits no more; nor do those before it, which it has replaced.
  #ended(id) {
    const asked = this.#waiting.get(id);
    for (const [each, {slot}] of this.#waiting) if (slot === asked?.slot && each <= id) this.#waiting.delete(each);
    return asked;
  }

  #connected({session, resumed, files, version}) {
    const isAgain = this.session !== null, isElsewhere = this.#isElsewhere;
    this.session = session;
    this.#isElsewhere = false;
    this.#delay = SOON;
    remember("session", session);
    this.#told.open({isAgain, resumed, isElsewhere, version});
    for (const message of this.#unsaid.values()) this.#send(message);
    this.#unsaid.clear();
    for (const [id, {message, replaced}] of this.#waiting) {
      if (replaced) this.#waiting.delete(id);
      else this.#send(message);
    }
    this.#opened({resumed, files});
  }

  #answered(buffer) {
    this.#ended(Number(new DataView(buffer).getBigUint64(0, true)))?.answer(unpacked(buffer, 8));
  }
}

const TYPES = {uint8: Uint8Array, uint32: Uint32Array};

// A message of the server: its header, with the arrays in it as {values, shape, dtype}.
function unpacked(buffer, start) {
  const length = new DataView(buffer).getUint32(start, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, start + 4, length)));
  const data = start + 4 + length;
  for (const [name, {dtype, shape, offset, low, step, above}] of Object.entries(header.arrays)) {
    const count = shape.reduce((product, n) => product * n, 1);
    header.arrays[name] = dtype === "packed"
      ? {dtype: "float32", shape, above, step, values: numbersOf(new Uint8Array(buffer, data + offset), count, shape[1], low, step)}
      : {dtype, shape, values: new TYPES[dtype](buffer, data + offset, count)};
  }
  return header;
}

// Numbers of a map as the server packs them: second differences of steps, upper bytes first, and a bit for each
// that is not known.
function numbersOf(bytes, count, columns, low, step) {
  const steps = new Uint16Array(count), values = new Float32Array(count);
  for (let i = 0; i < count; i += 1) {
    const turned = bytes[i] * 256 + bytes[count + i], left = i % columns ? steps[i - 1] : 0;
    const above = i < columns ? 0 : steps[i - columns] - (i % columns ? steps[i - columns - 1] : 0);
    steps[i] = (turned >>> 1 ^ -(turned & 1)) + left + above; // which wraps at 2^16
    values[i] = bytes[2 * count + (i >> 3)] & (128 >> (i & 7)) ? NaN : low + step * steps[i];
  }
  return values;
}

// Take from arrays that were sent as sums what they are above.
export function settle(arrays) {
  for (const {above, values} of Object.values(arrays)) {
    if (above) values.forEach((sum, i) => { values[i] = Math.max(0, sum - arrays[above].values[i]); });
  }
}
