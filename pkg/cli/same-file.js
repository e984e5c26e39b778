/** Whether the command would write over a file that it reads, or write two files to one place. */
import { readlinkSync, realpathSync } from 'node:fs';
import { basename, dirname, join, resolve } from 'node:path';
import { usage } from './flags.js';

/** @typedef {Record<string, string | undefined>} NamedPaths what a file is for, and where it is */

/**
 * Refuses to write two files to one place, and to replace a file that is read unless that is wanted.
 * @param {object} files
 * @param {NamedPaths} files.written
 * @param {NamedPaths} files.read
 * @param {boolean} [files.force] whether files that are read may be replaced
 */
export function refuseSameFiles({ written, read, force = false }) {
  const outputs = located(written);
  outputs.forEach(({ name, path, place }, i) => {
    const twin = outputs.slice(0, i).find((other) => other.place === place);
    if (twin !== undefined) {
      throw usage(`the ${twin.name} and the ${name} are the same file, ${path}: choose another name for one of them`);
    }
  });
  if (force) return;
  // Standard input is another stream than standard output.
  const inputs = located(read).filter(({ path }) => path !== '-');
  for (const { name, path, place } of outputs) {
    const source = inputs.find((other) => other.place === place);
    if (source !== undefined) {
      throw usage(
        `the ${source.name} and the ${name} are the same file, and ${path} would be replaced: choose another name for the ${name}, ` +
          'or add --force to replace it',
      );
    }
  }
}

/** @param {NamedPaths} files */
function located(files) {
  return Object.entries(files).flatMap(([name, path]) => (path === undefined ? [] : [{ name, path, place: canonicalPath(path) }]));
}

/** Maximum number of links that are followed one after the other; a circle of links has no end. */
const MAX_LINKS = 40;

/**
 * The absolute path of a file without any links, also of one that is not there yet.
 * @param {string} path
 * @param {number} [links] how many may still be followed
 * @returns {string}
 */
function canonicalPath(path, links = MAX_LINKS) {
  try {
    // The native one knows how the file system spells the name, where that ignores case.
    return realpathSync.native(path);
  } catch {
    const folder = dirname(resolve(path));
    if (folder === resolve(path)) return folder;
    const target = links > 0 ? linkTarget(path) : undefined;
    return target === undefined
      ? join(canonicalPath(folder, links), basename(path))
      : canonicalPath(resolve(folder, target), links - 1);
  }
}

/** Where a link leads, though nothing is there. @param {string} path */
function linkTarget(path) {
  try {
    return readlinkSync(path);
  } catch {
    return undefined;
  }
}
