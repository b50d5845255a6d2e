// WebSockets that come back by themselves: what was missed is asked for again by its number.

/** Where a stream is: `open`, `waiting` to try again, or `closed` for good with the reason of the server. */
export type StreamStatus = { state: "connecting" | "open" | "waiting" } | { state: "closed"; reason: string };

export interface StreamOptions {
  path: "/events" | "/samples";
  /** The first message, made for each connection anew, so that it can say what is known already. */
  hello: () => Record<string, unknown>;
  onMessage: (data: string | ArrayBuffer) => void;
  onStatus?: (status: StreamStatus) => void;
}

const ENDED = 1000;
const REFUSED = 1008;
const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 4000;

/** Connect, and again after each loss; the function that is returned ends it. */
export function openStream(options: StreamOptions): () => void {
  let socket: WebSocket | null = null;
  let timer = 0;
  let wait = FIRST_WAIT_MS;
  let over = false;
  const say = (status: StreamStatus): void => options.onStatus?.(status);

  const connect = (): void => {
    say({ state: "connecting" });
    socket = new WebSocket(`${location.origin.replace(/^http/, "ws")}/api/v1${options.path}`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      socket?.send(JSON.stringify(options.hello()));
      say({ state: "open" });
    };
    socket.onmessage = (message: MessageEvent<string | ArrayBuffer>) => {
      wait = FIRST_WAIT_MS;
      options.onMessage(message.data);
    };
    socket.onclose = (event) => {
      if (over) return;
      if (event.code === ENDED || event.code === REFUSED) {
        over = true;
        say({ state: "closed", reason: event.code === ENDED ? "" : event.reason });
        return;
      }
      say({ state: "waiting" });
      timer = window.setTimeout(connect, wait);
      wait = Math.min(wait * 2, LONGEST_WAIT_MS);
    };
  };

  connect();
  return () => {
    over = true;
    window.clearTimeout(timer);
    socket?.close();
  };
}
