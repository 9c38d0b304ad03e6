// Chromium and its driver, for the tests that need a browser.
import { existsSync } from 'node:fs';
import { StepFailed, run, say, which } from './run.mjs';

const CANDIDATES = {
  chromium: ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome'],
  chromedriver: ['chromedriver', 'chromium.chromedriver'],
};

function find(name) {
  const given = process.env[name.toUpperCase()];
  if (given && existsSync(given)) return given;
  return CANDIDATES[name].map(which).find(Boolean);
}

/** Paths of Chromium and chromedriver; installs them with apt-get where they are missing. */
export async function browser() {
  if ((!find('chromium') || !find('chromedriver')) && which('apt-get')) {
    say('installing Debian packages: chromium chromium-driver');
    const sudo = process.getuid() === 0 ? [] : ['sudo', '-n'];
    for (const args of [['update'], ['install', '-y', '--no-install-recommends', 'chromium', 'chromium-driver']]) {
      const [command, ...rest] = [...sudo, 'apt-get', ...args];
      await run(command, rest, { quiet: true, env: { DEBIAN_FRONTEND: 'noninteractive' } });
    }
  }
  const found = { chromium: find('chromium'), chromedriver: find('chromedriver') };
  for (const [name, path] of Object.entries(found)) {
    if (path) continue;
    throw new StepFailed(
      `${name} is missing. On Debian: apt-get install -y --no-install-recommends chromium chromium-driver; ` +
        `elsewhere set ${name.toUpperCase()} to its path`,
    );
  }
  return found;
}
