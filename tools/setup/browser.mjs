/** A Chromium or Chrome, and its driver for wasm-bindgen's tests. */
import { Problem } from '../util/problem.mjs';
import { isProgram, which } from '../util/which.mjs';
import { aptInstall, isDebian, isRoot } from './apt.mjs';
import { task } from './task.mjs';

/**
 * @typedef {object} Browser
 * @property {string} [chrome]
 * @property {string} [driver]
 */

const { ProgramFiles, 'ProgramFiles(x86)': ProgramFiles86, LOCALAPPDATA } = process.env;

/** Where browsers are that are not on the search path. */
const usual = {
  darwin: [
    '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
    '/Applications/Chromium.app/Contents/MacOS/Chromium',
  ],
  win32: [ProgramFiles, ProgramFiles86, LOCALAPPDATA]
    .map((folder) => `${folder}\\Google\\Chrome\\Application\\chrome.exe`),
};

/** @returns {Promise<Browser>} */
export async function browser() {
  const found = find();
  if ((found.chrome && found.driver) || !isDebian || !isRoot) return found;
  await task("Chromium and its driver, as Debian's packages (130 MB)", 'about 1 minute', async () => {
    const { ok, failure } = await aptInstall('chromium', 'chromium-driver');
    if (!ok) console.log(`  apt-get could not install them (${failure})`);
  });
  return find();
}

/** @returns {Browser} */
function find() {
  const places = Object.entries(usual).find(([platform]) => platform === process.platform)?.[1] ?? [];
  return {
    chrome: chosen('CHROME')
      ?? which('chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome')
      ?? places.find(isProgram),
    driver: chosen('CHROMEDRIVER')
      ?? which('chromedriver')
      ?? ['/usr/lib/chromium/chromedriver', '/usr/lib/chromium-browser/chromedriver'].find(isProgram),
  };
}

/** @param {string} variable */
function chosen(variable) {
  const path = process.env[variable];
  if (path && !isProgram(path)) {
    throw new Problem(`${variable} is set to ${path}, which is no program: correct it or unset it.`);
  }
  return path || undefined;
}
