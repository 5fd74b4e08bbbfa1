// YAML as the engine's reader of refractiveindex.info files takes it: nodes [position, line, value].

import { LineCounter, isAlias, isMap, isScalar, isSeq, parseDocument } from "yaml";

export function parseYaml(text: string): string {
  const lines = new LineCounter();
  const document = parseDocument(text, { lineCounter: lines, uniqueKeys: false, schema: "failsafe" });
  const line = (position: number) => Math.max(0, lines.linePos(position).line - 1);
  const problem = document.errors[0];
  if (problem) return JSON.stringify({ error: problem.message.split("\n")[0], line: line(problem.pos[0]) });
  const value = (node: unknown): unknown => {
    if (isScalar(node)) return typeof node.value === "string" ? node.value : node.value === null ? null : String(node.value);
    if (isSeq(node)) return node.items.map(marked);
    if (isMap(node)) return { map: node.items.map((pair) => [marked(pair.key), marked(pair.value)]) };
    return null;
  };
  const marked = (node: unknown): unknown => {
    const target = isAlias(node) ? node.resolve(document) : node;
    const range = isScalar(target) || isSeq(target) || isMap(target) ? target.range : null;
    const at = range ? range[0] : 0;
    return [at, line(at), value(target)];
  };
  return JSON.stringify({ node: marked(document.contents) });
}
