// Finds or installs what the other scripts need: Rust for WebAssembly, wasm-bindgen, npm packages, a browser.
// They call the same functions when they come to need them; this does it ahead of time.
import { browser } from './tools/browser.mjs';
import { npmInstall } from './tools/npm.mjs';
import { program, say } from './tools/run.mjs';
import { bindgenTools, wasmToolchain } from './tools/rust.mjs';

await program(async () => {
  await npmInstall();
  const toolchain = await wasmToolchain();
  say(`Rust for WebAssembly: ${toolchain === 'rustup' ? "rustup's nightly with rust-src" : "Debian's rustc-web"}`);
  const { bindgen } = await bindgenTools();
  say(`wasm-bindgen: ${bindgen}`);
  const { chromium, chromedriver } = await browser();
  say(`browser: ${chromium}, ${chromedriver}`);
});
