// What the page holds packed: gzip in base64.
export async function unpack(element) {
  const bytes = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

export async function unpackJson(element) {
  return JSON.parse(new TextDecoder().decode(await unpack(element)));
}
