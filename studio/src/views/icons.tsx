// Icons, drawn on a grid of 16; those of states differ in shape, not only in colour.
import type { JSX } from "preact";

const PATHS = {
  play: <path class="filled" d="M5 3.2v9.6L12.5 8z" />,
  pause: <path d="M5.5 3.5v9M10.5 3.5v9" stroke-width="2.4" />,
  stop: <rect class="filled" x="3.5" y="3.5" width="9" height="9" rx="1" />,
  over: <path d="M2.5 9.5a5.5 5.5 0 0 1 10.3-2M13 3.8v3.9H9.2M8 12.6h.01" />,
  into: <path d="M8 2.5v7M5 6.7l3 3 3-3M8 13.3h.01" />,
  out: <path d="M8 9.7v-7M5 5.5l3-3 3 3M8 13.3h.01" />,
  check: <path d="M3 8.5l3.3 3.3L13 4.7" stroke-width="2" />,
  cross: <path d="M4 4l8 8M12 4l-8 8" stroke-width="2" />,
  halted: <path d="M3.5 8h9" stroke-width="2.4" />,
  dot: <circle class="filled" cx="8" cy="8" r="3.4" />,
  ring: <circle cx="8" cy="8" r="4" />,
  hourglass: <path d="M4 2.5h8M4 13.5h8M5 2.5c0 3 6 5 6 5.5s-6 2.5-6 5.5M11 2.5c0 3-6 5-6 5.5s6 2.5 6 5.5" />,
  warning: <path d="M8 2.3L1.8 13.2h12.4zM8 6.5v3.2M8 11.5h.01" />,
  open: <path d="M4 6l4 4 4-4" />,
  closed: <path d="M6 4l4 4-4 4" />,
  expand: <path d="M9.5 2.5h4v4M6.5 13.5h-4v-4M13.5 2.5l-4.5 4.5M2.5 13.5L7 9" />,
  shrink: <path d="M13.5 6.5h-4v-4M2.5 9.5h4v4M9.5 6.5l4-4M6.5 9.5l-4 4" />,
  theme: <path d="M8 2a6 6 0 1 0 0 12zM8 2a6 6 0 0 1 0 12" />,
  help: <path d="M5.7 6a2.4 2.4 0 1 1 3.5 2.2c-.8.4-1.2.9-1.2 1.7M8 12.6h.01" />,
  link: <path d="M6.5 3.5h-3v9h9v-3M9 2.5h4.5V7M13.3 2.7L7.5 8.5" />,
  plug: <path d="M5.5 2v3M10.5 2v3M3.5 5h9v2a4.5 4.5 0 0 1-9 0zM8 11.5V14" />,
  locked: <path d="M4 7.5h8v6H4zM5.5 7.5V5a2.5 2.5 0 0 1 5 0v2.5" />,
  unlocked: <path d="M4 7.5h8v6H4zM5.5 7.5V4.5a2.5 2.5 0 0 1 4.8-1" />,
} satisfies Record<string, JSX.Element>;

export type IconName = keyof typeof PATHS;

/** An icon beside a text, or alone in a button with a label; never the only thing that says something. */
export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" aria-hidden="true">
      {PATHS[name]}
    </svg>
  );
}
