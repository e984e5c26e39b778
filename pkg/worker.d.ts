/** The worker's script, to be imported by a script of one's own that `workerUrl` names; it exports nothing. */
export {};
