// A server of a folder of its own, for one test.

import { type ChildProcess, spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

import { type Page, test as base, expect } from "@playwright/test";

const ROOT = resolve(import.meta.dirname, "../../..");
const PROGRAM = process.env["BARRIER_CHECK"] ?? join(ROOT, "target/release/barrier-check");

export class Server {
  address = "";
  private child: ChildProcess | null = null;

  constructor(readonly folder: string) {}

  async start(): Promise<void> {
    const child = spawn(PROGRAM, ["serve", this.folder, "--no-open"], { stdio: ["ignore", "pipe", "inherit"] });
    this.child = child;
    this.address = await new Promise((found, failed) => {
      child.stdout.on("data", (data: Buffer) => {
        const address = /http:\S+/.exec(data.toString());
        if (address) found(address[0]);
      });
      child.on("exit", () => failed(new Error("the server ended")));
    });
  }

  async end(signal: NodeJS.Signals = "SIGTERM"): Promise<void> {
    const child = this.child;
    if (!child || child.exitCode !== null) return;
    const over = new Promise((done) => child.on("exit", done));
    child.kill(signal);
    await over;
  }
}

interface Fixtures {
  server: Server;
  told: string[];
}

/** A page of a fresh server; nothing may appear on the console of the browser. */
export const test = base.extend<Fixtures>({
  // biome-ignore: Playwright wants a pattern here
  server: async ({}, use) => {
    const folder = mkdtempSync(join(tmpdir(), "barrier-check-page-"));
    for (const design of ["small_net", "rigid_wall"]) copyFileSync(join(ROOT, `designs/${design}.yaml`), join(folder, `${design}.yaml`));
    const server = new Server(folder);
    await server.start();
    await use(server);
    await server.end();
    rmSync(folder, { recursive: true, force: true });
  },
  told: [
    // The server is named so that it ends after this: a page that looks for one that is gone says so on its console, rightly.
    async ({ page, server: _ }, use) => {
      const told: string[] = [];
      page.on("console", (message) => told.push(`${message.type()}: ${message.text()} ${message.location().url}`));
      page.on("pageerror", (error) => told.push(error.message));
      await use(told);
      expect(told).toEqual([]);
    },
    { auto: true },
  ],
});

export { expect };

/** A picture of the page, where pictures are wanted. */
export async function shoot(page: Page, name: string): Promise<void> {
  const folder = process.env["SCREENSHOTS"];
  if (folder) await page.screenshot({ path: join(folder, `${name}.png`) });
}
