// What emscripten makes of web/engine, and what the worker uses of it.
declare module "@engine/engine.js" {
  export interface EngineModule {
    _malloc(bytes: number): number;
    _free(address: number): void;
    _hts_request(request: number, input: number, inputs: number, output: number, outputs: number): number;
    HEAPF64: Float64Array;
    UTF8ToString(address: number): string;
    stringToUTF8(text: string, address: number, size: number): void;
    lengthBytesUTF8(text: string): number;
    FS: { writeFile(path: string, data: string | Uint8Array): void };
    parseYaml(text: string): string;
  }
  export default function make(options: {
    wasmBinary: Uint8Array;
    parseYaml: (text: string) => string;
    print?: (text: string) => void;
    printErr?: (text: string) => void;
  }): Promise<EngineModule>;
}
declare module "@engine/engine.bin?url" {
  const url: string;
  export default url;
}
