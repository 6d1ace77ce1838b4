// Undo and redo, cases from files, and all that leaves the page: texts to copy, files that the program writes.
import { useEffect, useRef } from 'preact/hooks';
import { exportFile, readCase, type ExportRequest } from '../api';
import { notify, notifyFailure } from '../shell/notices';
import { sendSession } from '../shell/session';
import { useStore } from '../shell/store';
import { caseOf, sectionsOf } from './case';
import { looks, paintsOf } from './looks';
import * as model from './model';
import { base64, picturePng, pictureSvg } from './picture';

/** The clipboard, or where the browser gives none (a page over plain HTTP) the older way. */
async function copy(text: string, what: string): Promise<void> {
  if (navigator.clipboard) await navigator.clipboard.writeText(text);
  else {
    const area = document.createElement('textarea');
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  notify(`${what} is in the clipboard.`);
}

async function save(request: ExportRequest): Promise<void> {
  const { file } = await exportFile(request);
  notify(`Written: ${file}`);
}

function drawnPicture() {
  const solved = model.solved.get();
  if (!solved) throw new Error('There is no state to draw yet.');
  const legends = solved.fields ? paintsOf(solved.fields, looks.get()).legends : [];
  return pictureSvg(legends, solved);
}

async function saveSvg(): Promise<void> {
  const data = await base64(new Blob([drawnPicture().svg]));
  await save({ what: 'svg', name: 'cell.svg', data });
}

async function savePng(): Promise<void> {
  const data = await base64(await picturePng(drawnPicture()));
  await save({ what: 'png', name: 'cell.png', data });
}

async function saveSession(): Promise<void> {
  await sendSession();
  await save({ what: 'session', name: 'session.toml' });
}

const currentCase = () => sectionsOf(model.values.get());

const actions: [string, () => Promise<void>][] = [
  ['Copy as command', async () => copy((await model.textsOfCase()).command, 'The command')],
  ['Copy as Python', async () => copy((await model.textsOfCase()).python, 'The Python code')],
  ['Copy link', async () => copy(window.location.href, 'The link')],
  ['Save case.toml', () => save({ what: 'case', name: 'case.toml', case: currentCase() })],
  ['Save result folder', () => save({ what: 'result', name: 'cell', case: currentCase() })],
  ['Save picture (SVG)', saveSvg],
  ['Save picture (PNG)', savePng],
  ['Save session', saveSession],
];

function Menu() {
  const menu = useRef<HTMLDetailsElement | null>(null);
  const close = () => (menu.current!.open = false);
  const act = (action: () => Promise<void>) => {
    close();
    menu.current!.querySelector('summary')!.focus();
    void Promise.resolve().then(action).catch(notifyFailure);
  };
  useEffect(() => {
    const elsewhere = (event: PointerEvent) => menu.current!.contains(event.target as Node) || close();
    document.addEventListener('pointerdown', elsewhere);
    return () => document.removeEventListener('pointerdown', elsewhere);
  }, []);
  return (
    <details ref={menu} class="menu" onKeyDown={(event) => event.key === 'Escape' && act(async () => undefined)}>
      <summary>Export</summary>
      <div class="menu-list">
        {actions.map(([title, action]) => (
          <button key={title} class="quiet" onClick={() => act(action)}>
            {title}
          </button>
        ))}
      </div>
    </details>
  );
}

async function openFile(files: FileList | null): Promise<void> {
  const file = files?.[0];
  if (!file) return;
  const { case: read } = await readCase(await file.text());
  model.openCase(caseOf(read));
}

/** Undo and redo by the usual keys, except in a text that is being written. */
function useUndoKeys(): void {
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      const writing = event.target instanceof HTMLInputElement && event.target.type === 'text';
      if (!(event.ctrlKey || event.metaKey) || writing) return;
      const key = event.key.toLowerCase();
      if (key === 'z' && !event.shiftKey) model.undo();
      else if (key === 'y' || key === 'z') model.redo();
      else return;
      event.preventDefault();
    };
    window.addEventListener('keydown', pressed);
    return () => window.removeEventListener('keydown', pressed);
  }, []);
}

export function CellTools() {
  const steps = useStore(model.steps);
  const chosen = useRef<HTMLInputElement | null>(null);
  useUndoKeys();
  return (
    <div class="tools" role="toolbar" aria-label="Case">
      <button onClick={model.undo} disabled={!steps.canUndo} title="Ctrl+Z">
        Undo
      </button>
      <button onClick={model.redo} disabled={!steps.canRedo} title="Ctrl+Shift+Z">
        Redo
      </button>
      <button onClick={() => chosen.current!.click()}>Open case …</button>
      <input
        ref={chosen}
        type="file"
        accept=".toml"
        hidden
        onChange={(event) => void openFile(event.currentTarget.files).catch(notifyFailure)}
      />
      <Menu />
    </div>
  );
}
