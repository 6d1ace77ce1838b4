// The address of the page: #cell?cell.radius_um=7.66&... or #recordings?item=0. A link restores what it says.
import { store } from './store';

export type Workspace = 'cell' | 'recordings';
export interface Place {
  workspace: Workspace;
  query: URLSearchParams;
}

export function parsePlace(hash: string): Place {
  const [name, query] = hash.replace(/^#/, '').split('?', 2);
  return { workspace: name === 'recordings' ? 'recordings' : 'cell', query: new URLSearchParams(query ?? '') };
}

export const place = store<Place>(parsePlace(window.location.hash));

const written = ({ workspace, query }: Place) => {
  const text = query.toString();
  return `#${workspace}${text ? `?${text}` : ''}`;
};

/** Changes the address in its place: no entry in the browser's history, no reloading. */
export function replacePlace(next: Place): void {
  window.history.replaceState(null, '', written(next));
  place.set(next);
}

/** Goes to another workspace; the browser's back button returns. */
export function goTo(next: Place): void {
  window.history.pushState(null, '', written(next));
  place.set(next);
}

export function startPlace(): void {
  const read = () => place.set(parsePlace(window.location.hash));
  window.addEventListener('popstate', read);
  window.addEventListener('hashchange', read);
}
