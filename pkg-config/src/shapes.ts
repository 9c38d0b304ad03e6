// Soups and clouds as the caller holds them. The same classes serve both entries: a caller that posts to a worker
// answers with promises, one that runs the engine itself with values.
import type { Accuracy, CallOptions, CloudArrays, Layer, OrientOptions, ReadOptions, SoupArrays } from './api.js';
import { WindingError } from './error.js';
import { type Caller, Held, type View, forEngine, handOver } from './held.js';
import type { Description } from './protocol.js';
import type { TextureReport } from './texture-api.js';
import { TextureOfSoup } from './textures.js';

function asBytes(data: Uint8Array | ArrayBuffer, transfer: boolean | undefined): unknown {
  // Not a subclass such as Node's Buffer, which often lies in a pool shared with others.
  if (ArrayBuffer.isView(data) && data.constructor !== Uint8Array) {
    return new Uint8Array(data.buffer, data.byteOffset, data.byteLength).slice();
  }
  const own = handOver(data, transfer);
  return own instanceof ArrayBuffer ? new Uint8Array(own) : own;
}

/** Numbers that describe a layer, and how many of them make a block that is sliced together. */
const LAYERS_AT_ONCE = 3 * 64;

class BaseShape extends Held {
  readonly kind: 'soup' | 'cloud';
  readonly format: string;
  readonly warnings: Description['warnings'];
  readonly bounds: Description['bounds'];
  readonly count: number;

  constructor(caller: Caller, handle: number, description: Description) {
    super(caller, handle, description.kind);
    this.kind = description.kind;
    this.format = description.format;
    this.warnings = description.warnings;
    this.bounds = description.bounds;
    this.count = description.count;
  }

  /** Asks for a soup that is made of this shape: the answer with it as `soup`. */
  protected derive(method: string, args: unknown[], options?: object): unknown {
    const makes = this.caller.newHandle();
    return this.caller.then(this.ask(method, args, options, makes), (value) => {
      const { shape, ...rest } = value as { shape: Description };
      return { soup: new SoupShape(this.caller, makes, shape), ...rest };
    });
  }

  prepare(options?: object): unknown {
    return this.ask('prepare', [forEngine(options)], options);
  }

  windingNumbers(points: View, options?: Accuracy & CallOptions): unknown {
    return this.ask('windingNumbers', [handOver(points, false), forEngine(options)], options);
  }

  contains(points: View, options?: CallOptions): unknown {
    return this.ask('contains', [handOver(points, false), forEngine(options)], options);
  }

  voxelize(options?: object): unknown {
    return this.ask('voxelize', [forEngine(options)], options);
  }

  voxelBricks(options?: object): unknown {
    return this.ask('voxelBricks', [forEngine(options)], options);
  }

  save(options?: CallOptions): unknown {
    return this.ask('save', [], options);
  }

  slice(options?: object): unknown {
    return this.ask('slice', [forEngine(options)], options);
  }

  layers(options?: object): unknown {
    const spans = this.ask('layerSpans', [forEngine(options)], options);
    return this.caller.each(spans, LAYERS_AT_ONCE, (some) => this.ask('slice', [{ ...(forEngine(options) as object), spans: some }], options));
  }

  surface(options?: object): unknown {
    return this.ask('surface', [forEngine(options)], options);
  }

  signedDistance(what: View | object = {}, options?: CallOptions): unknown {
    if (ArrayBuffer.isView(what)) return this.ask('signedDistance', [handOver(what as View, false), forEngine(options)], options);
    return this.ask('distanceLattice', [forEngine(what)], what);
  }

  closestPoints(points: View, options?: CallOptions): unknown {
    return this.ask('closestPoints', [handOver(points, false), forEngine(options)], options);
  }

  offset(options: object): unknown {
    return this.ask('offset', [forEngine(options)], options);
  }

  repair(options?: object): unknown {
    return this.derive('repair', [forEngine(options)], options);
  }

  texture(options?: object): unknown {
    const makes = this.caller.newHandle();
    return this.caller.then(this.ask('texture', [forEngine(options)], options, makes), (value) => {
      const { shape: report } = value as { shape: TextureReport };
      return new TextureOfSoup(this.caller, makes, report);
    });
  }

  suggestOffset(options?: object): unknown {
    return this.ask('suggestOffset', [forEngine(options)], options);
  }

  project(options?: object): unknown {
    return this.ask('project', [forEngine(options)]);
  }

  heatMap(options: object): unknown {
    return this.ask('heatMap', [forEngine(options)], options);
  }

  boolean(operation: string, other: unknown, options: CallOptions & { transform?: ArrayLike<number> } = {}): unknown {
    if (!(other instanceof BaseShape) || other.caller !== this.caller) {
      return this.caller.fail(new WindingError('InvalidArgument', 'the other operand must be a shape of the same engine'));
    }
    if (other.isFreed) return this.caller.fail(new WindingError('Freed', `the other ${other.kind} was freed`));
    const { transform, ...rest } = options;
    const matrix = transform && Array.from(transform);
    const answer = this.ask('boolean', [operation, other.handle, matrix, forEngine(rest)], options);
    return this.caller.then(answer, (combined) => {
      const { positions, indices, faces, operands, warnings } = combined as Combined;
      if (faces.length === 0) return { soup: null, faces, operands, warnings };
      const made = make(this.caller, 'soup', [positions, indices], options, warnings);
      return this.caller.then(made, (soup) => ({ soup, faces, operands, warnings }));
    });
  }

  export(format: string): unknown {
    return this.ask('export', [format]);
  }

  geometry(): unknown {
    return this.ask('geometry', []);
  }
}

/** What the engine answers to `boolean`. */
interface Combined {
  positions: Float64Array;
  indices: Uint32Array;
  faces: Uint32Array;
  operands: Uint8Array;
  warnings: Description['warnings'];
}

class SoupShape extends BaseShape {
  toCloud({ at = 'vertices', ...options }: CallOptions & { at?: string } = {}): unknown {
    return this.caller.then(this.ask('asCloud', [at], options), (answer) => {
      const { points, normals, areas, warnings } = answer as Required<CloudArrays> & Pick<Description, 'warnings'>;
      return make(this.caller, 'cloud', [points, normals, areas, {}], options, warnings);
    });
  }

  hollow(options: object): unknown {
    return this.ask('hollow', [forEngine(options)], options);
  }

  boundaryEdges(): unknown {
    return this.ask('boundaryEdges', []);
  }

  check(options?: CallOptions): unknown {
    return this.ask('check', [forEngine(options)], options);
  }

  orient(options?: CallOptions): unknown {
    return this.ask('orientFaces', [forEngine(options)], options);
  }
}

class CloudShape extends BaseShape {
  hasNormals: boolean;
  hasAreas: boolean;

  constructor(caller: Caller, handle: number, description: Description) {
    super(caller, handle, description);
    this.hasNormals = description.hasNormals;
    this.hasAreas = description.hasAreas;
  }

  noise(options?: CallOptions): unknown {
    return this.ask('noise', [], options);
  }

  orient(options?: OrientOptions): unknown {
    return this.caller.then(this.ask('orient', [forEngine(options)], options), (description) => {
      Object.assign(this, description);
    });
  }
}

/** A new shape, about whose making there are `warnings` already. */
function make(caller: Caller, method: string, args: unknown[], options: object | undefined, warnings: Description['warnings'] = []): unknown {
  const handle = caller.newHandle();
  return caller.then(caller.call({ method, handle, args }, options as CallOptions | undefined), (value) => {
    const description = value as Description;
    const Shape = description.kind === 'soup' ? SoupShape : CloudShape;
    return new Shape(caller, handle, { ...description, warnings: [...warnings, ...description.warnings] });
  });
}

/** What `init` gives: both entries cast it to their own types. */
export function facade(caller: Caller): object {
  const parse = (kind: string | undefined) => (bytes: Uint8Array | ArrayBuffer, options?: ReadOptions & CallOptions) =>
    make(caller, 'parse', [asBytes(bytes, options?.transfer), kind, forEngine(options)], options);
  const ofEngine = (method: string, args: unknown[], options?: CallOptions) =>
    caller.call({ method, handle: 0, args }, options);
  const dispose = () => caller.dispose();
  return {
    info: caller.info,
    open: parse(undefined),
    load: parse('field'),
    Soup: {
      parse: parse('soup'),
      from: ({ positions, indices }: SoupArrays, options?: { transfer?: boolean }) =>
        make(caller, 'soup', [positions, indices].map((array) => handOver(array, options?.transfer)), options),
    },
    Cloud: {
      parse: parse('cloud'),
      from: ({ points, normals, areas }: CloudArrays, options?: { orient?: 'auto'; transfer?: boolean }) => {
        const arrays = [points, normals, areas].map((array) => handOver(array, options?.transfer));
        return make(caller, 'cloud', [...arrays, forEngine(options)], options);
      },
    },
    voxelSurface: (voxels: object) => ofEngine('voxelSurface', [voxels]),
    compareVoxels: (first: object, second: object) => ofEngine('compareVoxels', [first, second]),
    exportVoxels: (voxels: object, format: string, options?: object) => ofEngine('exportVoxels', [voxels, format, forEngine(options)]),
    exportLayer: (layer: Layer, format: string) => ofEngine('exportLayer', [layer, format]),
    exportLayers: (layers: Layer[], format: string, mesh?: object) => ofEngine('exportLayers', [layers, format, mesh]),
    toolpaths: (layers: Layer[], settings?: CallOptions) => ofEngine('toolpaths', [layers, forEngine(settings)], settings),
    gcode: (paths: object, profile?: object) => ofEngine('gcode', [paths, profile]),
    printSettings: ({ settings, profile, size }: { settings?: object; profile?: object; size?: number[] } = {}) =>
      ofEngine('printSettings', [settings, profile, size]),
    dispose,
    [Symbol.dispose]: dispose,
  };
}
