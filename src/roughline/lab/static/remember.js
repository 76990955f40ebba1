// What a tab remembers when its page is loaded again; storage may be closed.
export function recall(name) {
  try { return JSON.parse(sessionStorage.getItem(`roughline ${name}`)); } catch { return null; }
}

export function remember(name, value) {
  try { sessionStorage.setItem(`roughline ${name}`, JSON.stringify(value)); } catch { /* then it is not */ }
}
