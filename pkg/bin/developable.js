#!/usr/bin/env node
import { runProcess } from '../cli/main.js';

process.exitCode = await runProcess();
