// The libraries' unit tests as modules under node, side by side. A panic ends an instance of a module; the next one goes on
// with the next test. Usage: node tests/web/suite.mjs FOLDER-OF-THE-MODULES PART-OF-A-NAME MODULE…

import { readFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { setFlagsFromString } from 'node:v8';
import { Worker, isMainThread, parentPort, workerData } from 'node:worker_threads';

// A test that takes longer hangs.
const LIMIT_SECONDS = 120;

// What node 20's quick compiler makes of a wait for a time, such as `thread::sleep`, waits for ever.
setFlagsFromString('--no-liftoff');

if (isMainThread) await lead(...process.argv.slice(2));
else await work(workerData);

// Starts instances until every test is done, and tells what came of them.
async function lead(folder, part, ...names) {
  let run = 0;
  for (const name of names) run += await runSuite(folder, part, name);
  if (run > 0) return;
  console.log('FAILED: no test was run');
  process.exitCode = 1;
}

// Runs the tests of one module; how many it ran.
async function runSuite(folder, part, name) {
  const module = await WebAssembly.compile(readFileSync(join(folder, `${name}_bg.wasm`)));
  const script = pathToFileURL(resolve(folder, `${name}.mjs`)).href;
  const taken = new Int32Array(new SharedArrayBuffer(4));
  const suite = { tests: 0, passed: 0, failed: 0, ignored: 0, left: 0, broken: 0, seconds: [] };
  const begun = performance.now();
  const instance = async () => {
    while (await isCutShort({ module, script, taken, part }, suite));
  };
  await Promise.all(Array.from({ length: availableParallelism() }, instance));

  const slowest = suite.seconds.sort((a, b) => b.seconds - a.seconds).slice(0, 3);
  for (const { name, seconds } of slowest) console.log(`among the slowest: ${name}, ${seconds.toFixed(1)} s`);
  const elsewhere = part ? `, ${suite.left} of other names` : '';
  const seconds = ((performance.now() - begun) / 1000).toFixed(0);
  console.log(
    `${name}: ${suite.tests} tests: ${suite.passed} passed, ${suite.failed} failed, ${suite.ignored} ignored${elsewhere}; ${seconds} s`,
  );
  const done = suite.passed + suite.failed;
  const lost = suite.tests - done - suite.ignored - suite.left;
  if (lost !== 0) console.log(`FAILED: ${lost} tests were begun by nobody, or lost`);
  if (lost !== 0 || suite.failed > 0 || suite.broken > 0) process.exitCode = 1;
  return done;
}

// Lets an instance run tests; whether it came to an end before the tests did.
function isCutShort(data, suite) {
  return new Promise((ended) => {
    const worker = new Worker(fileURLToPath(import.meta.url), { workerData: data });
    let [test, message, cutShort, timer] = [null, null, true, null];
    const finish = (fault) => {
      clearTimeout(timer);
      const seconds = (performance.now() - test.since) / 1000;
      suite.seconds.push({ name: test.name, seconds });
      suite[fault === null ? 'passed' : 'failed'] += 1;
      if (fault !== null) console.log(`FAILED: ${test.name}, after ${seconds.toFixed(1)} s\n  ${fault.replaceAll('\n', '\n  ')}`);
      [test, message] = [null, null];
    };
    const heard = {
      tests: (count) => { suite.tests = count; },
      left: () => { suite.left += 1; },
      ignored: (name, why) => {
        suite.ignored += 1;
        console.log(`ignored: ${name}: ${why}`);
      },
      begin: (name, panics) => {
        test = { name, panics, since: performance.now() };
        timer = setTimeout(() => {
          message = `it takes more than ${LIMIT_SECONDS} s`;
          worker.terminate();
        }, LIMIT_SECONDS * 1000);
      },
      broken: (why) => { message = why; },
      end: (fault) => finish(fault ?? (test.panics === null ? null : 'it should have panicked')),
      done: () => { cutShort = false; },
    };
    worker.on('message', ([what, ...about]) => heard[what](...about));
    worker.on('error', (error) => { message ??= String(error); });
    worker.on('exit', () => {
      const fault = message ?? 'the instance ended';
      if (test?.panics != null) {
        finish(fault.includes(test.panics) ? null : `not with the words "${test.panics}": ${fault}`);
      } else if (test) {
        finish(fault);
      } else if (cutShort) {
        // The next one would end in the same way.
        console.log(`FAILED: the module does not run\n${fault}`);
        suite.broken += 1;
        cutShort = false;
      }
      ended(cutShort);
    });
  });
}

// An instance: `main` of the module runs the tests.
async function work({ module, script, taken, part }) {
  const tell = (...words) => parentPort.postMessage(words);
  let panic = '';
  globalThis.powderSuite = {
    next: (tests) => {
      tell('tests', tests);
      return Math.min(Atomics.add(taken, 0, 1), tests);
    },
    begin: (name, ignored, panics) => {
      if (!name.includes(part)) tell('left');
      else if (ignored !== undefined) tell('ignored', name, ignored);
      else tell('begin', name, panics ?? null);
      return name.includes(part) && ignored === undefined;
    },
    panicked: (message) => { panic = message; },
    end: (fault) => tell('end', fault ?? null),
  };
  try {
    (await import(script)).initSync({ module });
    tell('done');
  } catch (error) {
    tell('broken', panic || (error.stack ?? String(error)));
  }
}
