import type * as three from 'three';

/** As much of three's module as geometries take: `import * as THREE from 'three'`, or of `three/webgpu`. */
export type ThreeGeometry = Pick<typeof three, 'BufferGeometry' | 'BufferAttribute'>;

/** As much of it as textures take. */
export type ThreeTexture = Pick<
  typeof three,
  'DataTexture' | 'RedFormat' | 'RGBAFormat' | 'FloatType' | 'UnsignedByteType' | 'LinearFilter' | 'ClampToEdgeWrapping' | 'SRGBColorSpace'
>;
