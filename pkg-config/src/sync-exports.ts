export type * from './sync-api.js';
export type {
  Accuracy, Bounds, Bytes, CallOptions, CloudArrays, CloudFormat, HeatMap, Info, Layer, Mesh, OrientOptions, Polygon,
  Prepared, ReadOptions, RemeshOptions, Repaired, RepairOptions, RepairReport,
  ClosestPoints, DistanceLattice, DistanceLatticeOptions, DistanceOptions, Drain, HollowOptions, OffsetOptions,
  BoundaryLoop, CheckOptions, CheckReport, FaceOrientOptions, FieldRegion, IndexPairs, Indices, OrientedFaces, ReasonKind, Shell,
  AffectedTriangles, AtlasOptions, Distortion, FieldLines, MappingReport, Projected, Projection, ProxyGeometry, ProxyOptions, TexturedGeometry, TextureOptions, TextureReport, TextureSeams,
  GCode, LayerPaths, PathKind, PrinterProfile, Regions, RequiredProfile, ToolpathSettings, Toolpaths, SliceOptions, SoupArrays, SoupFormat, SurfaceOptions, VoxelOptions, Voxels, Warning,
} from './api.js';
export { WindingError, type ErrorCode } from './error.js';
export type { SyncInitOptions } from './sync-init.js';
