// The table of commands.
import type { Command } from '../command.js';
import { boolean } from './boolean.js';
import { check } from './check.js';
import { distance } from './distance.js';
import { info } from './info.js';
import { hollow, offset } from './offset.js';
import { orient } from './orient.js';
import { repair } from './repair.js';
import { slice } from './slice.js';
import { surface } from './surface.js';
import { texture } from './texture.js';
import { voxelize } from './voxelize.js';

/** In the order in which the help lists them. */
export const COMMANDS: readonly Command[] = [info, check, repair, orient, surface, slice, voxelize, boolean, offset, hollow, texture, distance];
