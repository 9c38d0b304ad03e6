// Builds what is missing and serves the page.
import { spawn } from 'node:child_process';
import { assemble } from './tools/assemble.mjs';
import { npmTool } from './tools/npm.mjs';
import { www } from './tools/paths.mjs';
import { program, say } from './tools/run.mjs';

await program(async () => {
  await assemble();
  say('serving the page');
  const server = spawn('node', [npmTool('vite', 'vite'), ...process.argv.slice(2)], { cwd: www, stdio: 'inherit' });
  for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => server.kill(signal));
  server.on('exit', (code) => process.exit(code ?? 0));
});
