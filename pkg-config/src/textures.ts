// Textures as the caller holds them: the same class for both entries, as shapes are.
import type { CallOptions } from './api.js';
import { type Caller, Held, forEngine, handOver } from './held.js';
import type { TextureReport } from './texture-api.js';

export class TextureOfSoup extends Held {
  constructor(
    caller: Caller,
    handle: number,
    public report: TextureReport,
  ) {
    super(caller, handle, 'texture');
  }

  geometry(): unknown {
    return this.ask('geometry', []);
  }

  proxy(): unknown {
    return this.ask('proxy', []);
  }

  affected(): unknown {
    return this.ask('affected', []);
  }

  lines(options?: object): unknown {
    return this.ask('lines', [forEngine(options)]);
  }

  seam(...vertices: number[]): unknown {
    return this.ask('seam', [vertices]);
  }

  transfer(values: Float32Array | Float64Array): unknown {
    return this.ask('transfer', [handOver(values, false)]);
  }

  remap(options?: CallOptions): unknown {
    return this.caller.then(this.ask('remap', [forEngine(options)], options), (report) => {
      this.report = report as TextureReport;
      return report;
    });
  }

  export(format: string, options?: object): unknown {
    return this.ask('export', [format, forEngine(options)]);
  }
}
