// From an empty page to a report, as somebody would who designs a barrier.

import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import type { Page } from "@playwright/test";

import { expect, shoot, test } from "./server";

const editor = (page: Page) => page.getByRole("textbox", { name: "Text of the design" });

/** Puts another text into the editor, as if it had been pasted. */
async function type(page: Page, text: string) {
  await editor(page).click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText(text);
}

test("a design is made from ten answers, spoilt, mended, simulated and read", async ({ page, server }) => {
  await page.goto(server.address);
  await expect(page).toHaveURL(/\/$/);
  await expect(page.getByText("Choose a design above")).toBeVisible();
  await shoot(page, "1-empty");
  await page.getByRole("button", { name: "New design" }).click();
  await page.getByLabel("File, in this folder").fill("my_net.yaml");
  await page.getByLabel("Width of the bed").fill("4 ells");
  await shoot(page, "2-ten-answers");
  await page.getByRole("button", { name: "Write it" }).click();
  await expect(page.locator("#new-wrong")).toContainText("`4 ells`");
  await page.getByLabel("Width of the bed").fill("4 m");
  await page.getByLabel("Height of the barrier").fill("2 m");
  await page.getByLabel("Volume of the event").fill("6 m3");
  await page.getByRole("button", { name: "Write it" }).click();
  await expect(page.locator("#verdict")).toContainText("by the equations alone");
  await expect(page.locator("#drawing svg").first()).toBeVisible();
  await shoot(page, "3-drawing");

  const text = readFileSync(join(server.folder, "my_net.yaml"), "utf8");
  await type(page, text.replace(/velocity: .*/, "velocity: 4 kn"));
  await expect(page.locator("#problems")).toContainText("velocity");
  await expect(page.locator(".cm-lintRange-error")).toHaveCount(1);
  await expect(page.getByRole("button", { name: "Simulate" })).toBeDisabled();
  await shoot(page, "4-problem");
  await page.locator("#problems button").first().click();
  await expect(editor(page)).toBeFocused();
  await type(page, text.replace(/velocity: .*/, "velocity: 4.5 m/s"));
  await expect(page.locator("#problems")).toBeHidden();
  await expect(page.locator("#state")).toHaveText("not saved");
  await page.keyboard.press("Control+S");
  await expect(page.locator("#state")).toHaveText("saved");
  expect(readFileSync(join(server.folder, "my_net.yaml"), "utf8")).toContain("velocity: 4.5 m/s");

  await page.getByRole("tab", { name: "Checks" }).click();
  await expect(page.locator("#checks td").first()).toBeVisible();
  await shoot(page, "5-checks");
  await page.getByRole("tab", { name: "Load cases" }).click();
  await expect(page.locator("#loads svg").first()).toBeVisible();
  await shoot(page, "6-load-cases");

  await page.getByRole("button", { name: "Simulate" }).click();
  await expect(page.locator("#simulation")).toContainText("of the event, force on the barrier");
  await expect(page.locator("#simulation canvas")).toBeVisible();
  await shoot(page, "7-simulation");
  const report = page.frameLocator("iframe.report");
  await expect(report.getByRole("heading", { name: "Checks", exact: true })).toBeVisible({ timeout: 90_000 });
  await shoot(page, "8-report");
  await expect(report.locator(".replay canvas")).toBeVisible();
});

test("a form writes into the text and leaves its comments", async ({ page, server }) => {
  await page.goto(server.address);
  await page.getByLabel("Design", { exact: true }).selectOption("small_net.yaml");
  await page.getByRole("tab", { name: "Form" }).click();
  const slope = page.locator("#field-channel-slope");
  await slope.fill("28 deg");
  await slope.press("Tab");
  await page.locator("#field-flow-grain_aspect").fill("1.4");
  await page.locator("#field-flow-grain_aspect").press("Tab");
  await page.locator("#field-limits-add, #field-project-add").first().selectOption("checker");
  await expect(page.locator("#field-project-checker")).toBeVisible();
  await page.locator("#field-project-checker").fill("N. N.");
  await page.locator("#field-project-checker").press("Tab");
  await slope.fill("95 deg");
  await slope.press("Tab");
  await expect(page.locator("#field-channel-slope-wrong")).toContainText("95 deg");
  await expect(slope).toHaveAttribute("aria-invalid", "true");
  await shoot(page, "9-form");
  await slope.fill("28 deg");
  await slope.press("Tab");
  await expect(page.locator("#problems")).toBeHidden();
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator("#state")).toHaveText("saved");
  const saved = readFileSync(join(server.folder, "small_net.yaml"), "utf8");
  expect(saved).toMatch(/slope: 28 deg +# against the horizontal/);
  expect(saved).toMatch(/grain_aspect: 1.4 /);
  expect(saved).toMatch(/checker: N. N./);
  // It can be undone, and lists of pairs and of groups grow without one being a copy by name of the other.
  await page.getByRole("button", { name: "Undo" }).click();
  await expect(slope).toHaveValue("95 deg");
  await page.getByRole("button", { name: "Redo" }).click();
  await page.locator("#field-channel-add").selectOption("profile");
  await page.locator("#field-channel-profile-add").selectOption("upstream");
  await page.locator("#field-channel-profile-upstream-0-0").fill("25 m");
  await page.locator("#field-channel-profile-upstream-0-0").press("Tab");
  await page.locator("#field-channel-profile-upstream-0-1").fill("14 deg");
  await page.locator("#field-channel-profile-upstream-0-1").press("Tab");
  await page.getByRole("button", { name: "Add to profile.upstream" }).click();
  await page.locator("#field-channel-profile-upstream-1-0").fill("60 m");
  await page.locator("#field-channel-profile-upstream-1-0").press("Tab");
  await page.keyboard.press("Control+S");
  await expect(page.locator("#state")).toHaveText("saved");
  const profiled = readFileSync(join(server.folder, "small_net.yaml"), "utf8");
  expect(profiled).toMatch(/upstream: \[ \[ 25 m, 14 deg \], \[ 60 m, 14 deg \] \]/);
  // What was not changed stands as it stood.
  expect(profiled).toContain("grain_friction: 40 deg             # grain on grain");
  expect(profiled).not.toContain("&a");
  await expect(page.locator("#problems")).toBeHidden();
  await page.getByRole("button", { name: "Remove channel.profile.upstream[1]" }).last().click();
  await expect(page.locator("#field-channel-profile-upstream-1-0")).toHaveCount(0);
});

test("keys are completed and told of", async ({ page, server }) => {
  await page.goto(server.address);
  await page.getByLabel("Design", { exact: true }).selectOption("small_net.yaml");
  await expect(page.locator(".cm-content")).toContainText("project");
  await type(page, "project:\n  name: A\nflow:\n  bulk");
  await page.keyboard.press("Control+Space");
  await expect(page.locator(".cm-tooltip-autocomplete")).toContainText("bulk_density");
  await shoot(page, "10-completion");
  // The editor takes no key as an answer to a list that has only just come (75 ms), lest somebody who types be taken by surprise.
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  await expect(editor(page)).toContainText("bulk_density: ");
  await page.keyboard.type("1800 k");
  await page.keyboard.press("Control+Space");
  await expect(page.locator(".cm-tooltip-autocomplete")).toContainText("1800 kg/m3");
  await page.keyboard.press("Escape");
  await page.locator(".cm-line", { hasText: "bulk_density" }).locator("span").first().hover();
  await expect(page.locator(".told")).toContainText("flow.bulk_density");
});

test("all is reached by keyboard alone", async ({ page, server }) => {
  await page.goto(server.address);
  await expect(page.getByLabel("Design", { exact: true }).locator("option", { hasText: "small_net" })).toBeAttached();
  const focused = () => page.evaluate(() => document.activeElement?.id || document.activeElement?.getAttribute("aria-label") || "");
  const tabTo = async (id: string) => {
    for (let step = 0; step < 300; step += 1) {
      await page.keyboard.press("Tab");
      if ((await focused()) === id) return;
    }
    throw new Error(`${id} is not reached`);
  };
  await tabTo("which");
  await page.keyboard.type("small");
  await page.keyboard.press("Enter");
  await expect(page.locator("#verdict")).toContainText("by the equations alone");
  await tabTo("tab-text");
  await page.keyboard.press("ArrowRight");
  expect(await focused()).toBe("tab-form");
  await expect(page.locator("#form")).toBeVisible();
  await tabTo("tab-drawing");
  for (const name of ["tab-checks", "tab-loads", "tab-simulation", "tab-reports"]) {
    await page.keyboard.press("ArrowRight");
    expect(await focused()).toBe(name);
  }
  await expect(page.locator("#reports")).toBeVisible();
  // The editor lets the focus go.
  await page.locator("#tab-text").click();
  await editor(page).focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  await expect(editor(page)).not.toBeFocused();
});

test("what is gone from the disk is written again, and a copy gets a name of its own", async ({ page, server, told }) => {
  await page.goto(server.address);
  await page.getByRole("combobox", { name: "Design" }).selectOption("small_net.yaml");
  await expect(page.locator("#state")).toHaveText("saved");
  page.once("dialog", (dialog) => void dialog.accept("copy"));
  await page.getByRole("button", { name: "Save as" }).click();
  await expect(page.getByRole("combobox", { name: "Design" })).toHaveValue("copy.yaml");
  rmSync(join(server.folder, "copy.yaml"));
  await page.evaluate(() => window.dispatchEvent(new Event("focus")));
  await expect(page.locator("#state")).toHaveText("not saved");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await expect(page.locator("#conflict")).toContainText("no longer on the disk");
  await page.getByRole("button", { name: "Keep mine" }).click();
  await expect(page.locator("#state")).toHaveText("saved");
  expect(readFileSync(join(server.folder, "copy.yaml"), "utf8")).toContain("flexible_net");
  // The browser tells of the file that was not there, twice asked for; of nothing else.
  expect(told.every((line) => line.includes("404") && line.includes("copy.yaml"))).toBe(true);
  told.length = 0;
});

test("two tabs do not overwrite each other", async ({ page, server, context }) => {
  await page.goto(server.address);
  await page.getByLabel("Design", { exact: true }).selectOption("small_net.yaml");
  await expect(page.locator("#state")).toHaveText("saved");
  const other = await context.newPage();
  await other.goto(new URL("/#small_net.yaml", server.address).href);
  await expect(other.locator("#verdict")).toContainText("by the equations alone");
  const text = readFileSync(join(server.folder, "small_net.yaml"), "utf8");
  await type(other, `${text}# the other tab\n`);
  await other.keyboard.press("Control+S");
  await expect(other.locator("#state")).toHaveText("saved");
  await type(page, `${text}# this tab\n`);
  await page.keyboard.press("Control+S");
  await expect(page.locator("#conflict")).toBeVisible();
  expect(readFileSync(join(server.folder, "small_net.yaml"), "utf8")).toContain("# the other tab");
  await page.getByRole("button", { name: "Keep mine" }).click();
  await expect(page.locator("#conflict")).toBeHidden();
  expect(readFileSync(join(server.folder, "small_net.yaml"), "utf8")).toContain("# this tab");
  await other.close();
});

test("a run is stopped, gone on with after the server was killed, and compared", async ({ page, server }) => {
  await page.goto(server.address);
  await page.getByLabel("Design", { exact: true }).selectOption("small_net.yaml");
  await expect(page.getByRole("button", { name: "Simulate" })).toBeEnabled();
  await page.getByRole("button", { name: "Simulate" }).click();
  await expect(page.locator("#simulation")).toContainText("of the event");
  await page.getByRole("button", { name: "Stop, and keep" }).click();
  await expect(page.getByRole("status").filter({ hasText: "The run was stopped" })).toBeVisible();
  // Not a page that asks a server that is gone: the browser tells of that.
  await page.goto("about:blank");
  await server.end("SIGKILL");
  await server.start();
  await page.goto(server.address);
  await page.getByRole("tab", { name: "Reports" }).click();
  await page.getByRole("button", { name: "Go on with it: small_net" }).click();
  await expect(page.frameLocator("iframe.report").getByRole("heading", { name: "Checks", exact: true })).toBeVisible({ timeout: 90_000 });
  const text = readFileSync(join(server.folder, "small_net.yaml"), "utf8");
  writeFileSync(join(server.folder, "steeper.yaml"), text.replace("slope: 25 deg", "slope: 26 deg"));
  await page.reload();
  await page.getByLabel("Design", { exact: true }).selectOption("steeper.yaml");
  await expect(page.getByRole("button", { name: "Simulate" })).toBeEnabled();
  await page.getByRole("button", { name: "Simulate" }).click();
  await expect(page.frameLocator("iframe.report").getByText("steeper")).toBeVisible({ timeout: 90_000 });
  await page.getByLabel("Compare small_net").check();
  await page.getByLabel("Compare steeper").check();
  await page.getByRole("button", { name: "Hold the two" }).click();
  await expect(page.locator("iframe.report")).toHaveAttribute("src", /compare\.html$/, { timeout: 30_000 });
  await expect(page.frameLocator("iframe.report").getByText("steeper").first()).toBeVisible();
  await shoot(page, "11-compared");
});

test("text stands out from what is behind it", async ({ page, server }) => {
  await page.goto(server.address);
  await page.getByLabel("Design", { exact: true }).selectOption("small_net.yaml");
  await expect(page.locator("#verdict")).toContainText("by the equations alone");
  for (const tab of ["Drawing", "Checks", "Load cases", "Simulation", "Reports"]) {
    await page.getByRole("tab", { name: tab, exact: true }).click();
    await page.waitForTimeout(200);
    const faint = await page.evaluate(() => {
      const light = (colour: string): [number, number] => {
        const [red = 0, green = 0, blue = 0, alpha = 1] = (colour.match(/[\d.]+/g) ?? []).map(Number);
        const part = (value: number) => (value / 255 <= 0.03928 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
        return [0.2126 * part(red) + 0.7152 * part(green) + 0.0722 * part(blue), alpha];
      };
      const behind = (element: Element | null): number => {
        for (let at = element; at; at = at.parentElement) {
          const [found, alpha] = light(getComputedStyle(at).backgroundColor);
          if (alpha > 0.99) return found;
        }
        return 1;
      };
      const told: string[] = [];
      const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      while (walker.nextNode()) {
        const element = walker.currentNode.parentElement;
        const text = walker.currentNode.textContent?.trim();
        if (!element || !text || !element.checkVisibility() || element.closest("svg, option, :disabled, .outdated, .cm-foldGutter")) continue;
        const [ink] = light(getComputedStyle(element).color);
        const back = behind(element);
        const ratio = (Math.max(ink, back) + 0.05) / (Math.min(ink, back) + 0.05);
        if (ratio < 4.5) told.push(`${ratio.toFixed(2)}: ${text}`);
      }
      return told;
    });
    expect(faint).toEqual([]);
  }
});
