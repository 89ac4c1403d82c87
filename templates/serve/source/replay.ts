// The flow against the barrier, from the side, as far as the simulation has come.

import { make } from "./elements";
import type { Picture } from "./server";

export interface Replay {
  element: HTMLElement;
  add(pictures: [number, Picture][]): void;
  clear(): void;
  /** Number of the last picture that is here. */
  last(): number;
}

export function makeReplay(): Replay {
  const canvas = make("canvas", { width: 960, height: 420, role: "img", "aria-label": "The flow and the barrier from the side" });
  const slider = make("input", { type: "range", min: 0, max: 0, value: 0, "aria-label": "Moment of the replay" });
  const time = make("output", {}, "");
  const caption = make("p", { class: "soft" }, "The first simulation from the side. The bed at the barrier is drawn level; gravity pulls along it.");
  const element = make("div", { class: "replay" }, canvas, make("div", { class: "replay-controls" }, slider, time), caption);
  let pictures: [number, Picture][] = [];
  let last = 0;
  let bounds = [Infinity, Infinity, -Infinity, -Infinity] as [number, number, number, number];

  const widen = (x: number, z: number) => {
    bounds = [Math.min(bounds[0], x), Math.min(bounds[1], z), Math.max(bounds[2], x), Math.max(bounds[3], z)];
  };
  const draw = () => {
    const shown = pictures[Number(slider.value)]?.[1];
    const pen = canvas.getContext("2d");
    if (!shown || !pen) return;
    const [left, low, right, high] = bounds;
    const margin = 16;
    const scale = Math.min((canvas.width - 2 * margin) / Math.max(right - left, 1), (canvas.height - 2 * margin) / Math.max(high - low, 1));
    const at = (x: number, z: number): [number, number] => [margin + (x - left) * scale, canvas.height - margin - (z - low) * scale];
    pen.fillStyle = "#ffffff";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    // Where the bed has another slope upstream, its grains lie below or above that at the barrier.
    if (low > -20) {
      pen.strokeStyle = "#5b6670";
      pen.beginPath();
      pen.moveTo(...at(left, 0));
      pen.lineTo(...at(right, 0));
      pen.stroke();
    }
    pen.fillStyle = "#a58a64";
    for (const [x, , z, radius] of shown.grains) {
      pen.beginPath();
      pen.arc(...at(x, z), Math.max(radius * scale, 1), 0, 2 * Math.PI);
      pen.fill();
    }
    pen.strokeStyle = "#0b4f8a";
    pen.lineWidth = 1.2;
    pen.beginPath();
    for (const [x, , z, toX, , toZ] of shown.ropes) {
      pen.moveTo(...at(x, z));
      pen.lineTo(...at(toX, toZ));
    }
    pen.stroke();
    const part = shown.one_of > 1 ? `; one grain of ${shown.one_of} is shown` : "";
    time.textContent = `${shown.time.toFixed(2)} s${part}`;
  };
  slider.addEventListener("input", draw);
  return {
    element,
    add: (more) => {
      const follows = Number(slider.value) >= pictures.length - 1;
      for (const [number, picture] of more) {
        last = Math.max(last, number);
        for (const [x, , z, radius] of picture.grains) {
          widen(x - radius, z - radius);
          widen(x + radius, z + radius);
        }
        for (const [x, , z, toX, , toZ] of picture.ropes) {
          widen(x, z);
          widen(toX, toZ);
        }
        pictures.push([number, picture]);
      }
      slider.max = String(Math.max(pictures.length - 1, 0));
      if (follows) slider.value = slider.max;
      if (more.length > 0) draw();
    },
    clear: () => {
      pictures = [];
      last = 0;
      bounds = [Infinity, Infinity, -Infinity, -Infinity];
      slider.max = "0";
      canvas.getContext("2d")?.clearRect(0, 0, canvas.width, canvas.height);
      time.textContent = "";
    },
    last: () => last,
  };
}
