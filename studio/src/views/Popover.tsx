// A button with what belongs to it one click away: closed by Escape, or by a click elsewhere.
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

interface PopoverProps {
  /** The name of the button, and of what it opens. */
  label: string;
  name: string;
  title: string;
  face: ComponentChildren;
  tone?: string;
  isRight?: boolean;
  children: (close: () => void) => ComponentChildren;
}

export function Popover({ label, name, title, face, tone = "", isRight = false, children }: PopoverProps) {
  const [isOpen, setIsOpen] = useState(false);
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!isOpen) return;
    const close = (event: Event): void => {
      const isInside = event.composedPath().includes(box.current as EventTarget);
      if (event instanceof KeyboardEvent ? event.key === "Escape" : !isInside) setIsOpen(false);
    };
    document.addEventListener("pointerdown", close);
    document.addEventListener("keydown", close);
    return () => {
      document.removeEventListener("pointerdown", close);
      document.removeEventListener("keydown", close);
    };
  }, [isOpen]);
  return (
    <div class="popover-of" ref={box}>
      <button
        class={`plain popover-button ${tone}`}
        aria-expanded={isOpen}
        aria-label={label}
        title={title}
        onClick={() => setIsOpen(!isOpen)}
      >
        {face}
      </button>
      {isOpen && (
        <section class={`popover stack ${isRight ? "is-right" : ""}`} aria-label={name}>
          {children(() => setIsOpen(false))}
        </section>
      )}
    </div>
  );
}
