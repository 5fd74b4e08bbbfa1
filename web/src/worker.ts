// The engine in a thread of its own, so that the page never waits for it.

import make, { type EngineModule } from "@engine/engine.js";
import { parseYaml } from "./yaml";

export type Call =
  | { id: number; start: ArrayBuffer }
  | { id: number; file: string; data: Uint8Array }
  | { id: number; request: string; input: Float64Array; outputs: number };

export interface Answer {
  id: number;
  text: string;
  output: Float64Array;
}

let engine: EngineModule;

function ask(text: string, input: Float64Array, outputs: number): { text: string; output: Float64Array } {
  const size = engine.lengthBytesUTF8(text) + 1;
  const request = engine._malloc(size);
  const numbers = engine._malloc(8 * (input.length + outputs) + 8);
  engine.stringToUTF8(text, request, size);
  engine.HEAPF64.set(input, numbers / 8);
  const behind = numbers + 8 * input.length;
  const answer = engine.UTF8ToString(engine._hts_request(request, numbers, input.length, behind, outputs));
  const output = engine.HEAPF64.slice(behind / 8, behind / 8 + outputs);
  engine._free(numbers);
  engine._free(request);
  return { text: answer, output };
}

self.onmessage = async (event: MessageEvent<Call>) => {
  const call = event.data;
  const reply = (text: string, output: Float64Array = new Float64Array(0)) =>
    (self as unknown as Worker).postMessage({ id: call.id, text, output } satisfies Answer, [output.buffer as ArrayBuffer]);
  try {
    if ("start" in call) {
      engine = await make({ wasmBinary: new Uint8Array(call.start), parseYaml });
      reply("{}");
    } else if ("file" in call) {
      engine.FS.writeFile("/" + call.file, call.data);
      reply("{}");
    } else {
      const { text, output } = ask(call.request, call.input, call.outputs);
      reply(text, output);
    }
  } catch (error) {
    reply(JSON.stringify({ error: String(error) }));
  }
};
