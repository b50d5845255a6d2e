// Logging in: with the code in the address that `skillc studio` opens, or with a token that a person pastes.
import { useState } from "preact/hooks";
import { api, ApiError } from "../api/client";
import { session } from "../state/studio";

/** Find out who is logged in; a code in the address is used once, and taken out of it. */
export async function findSession(): Promise<void> {
  const code = /^#code=(.+)$/.exec(location.hash)?.[1];
  if (code !== undefined) {
    history.replaceState(null, "", location.pathname);
    await api.logIn(decodeURIComponent(code)).catch(() => undefined);
  }
  try {
    session.value = await api.session();
  } catch {
    session.value = null;
  }
}

export function Login() {
  const [token, setToken] = useState("");
  const [problem, setProblem] = useState("");
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    try {
      await api.logIn(token.trim());
      session.value = await api.session();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setProblem(error.status === 401 ? "This token is not valid, or was revoked." : error.message);
    }
  };
  return (
    <main class="login">
      <form class="stack" onSubmit={(event) => void submit(event)}>
        <h1>skillc studio</h1>
        <p>
          Run <code>skillc studio</code> in the folder of the server, and it opens this page for you. Or paste
          a token:
        </p>
        <label class="stack">
          <span class="small muted">Token</span>
          <input
            class="mono"
            type="password"
            autocomplete="off"
            value={token}
            aria-invalid={problem !== ""}
            aria-describedby="login-problem"
            onInput={(event) => setToken(event.currentTarget.value)}
          />
        </label>
        <p id="login-problem" class={problem === "" ? "" : "notice bad"} role="alert">
          {problem}
        </p>
        <button class="primary" disabled={token.trim() === ""}>
          Log in
        </button>
        <p class="small muted">
          The token of the command line is in <code>admin.token</code> of the state folder;{" "}
          <code>skillc token add</code> makes others.
        </p>
      </form>
    </main>
  );
}
