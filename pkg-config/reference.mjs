// Makes the API references of the crate and of the package, and says where they are.
import { assemble } from './tools/assemble.mjs';
import { references } from './tools/reference.mjs';
import { program } from './tools/run.mjs';
import { requireCargo } from './tools/rust.mjs';

await program(async () => {
  requireCargo();
  await assemble();
  await references();
  console.log('target/doc/fast_winding/index.html\ntarget/typedoc/index.html');
});
