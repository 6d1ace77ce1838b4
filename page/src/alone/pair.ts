// Two programs in this page: one solves cells, the other knows the recordings and all else. A slider then waits for no
// recording, and a solution that is ended with its worker takes nothing with it.
import { type Program } from '../api';
import { ProgramInPage, type Listener, type Parts } from './program';

/** Whether a request is answered by what is solved for it. */
function isSolved(path: string, { body }: RequestInit): boolean {
  const [address] = path.split('?');
  return address === '/api/state' || address === '/api/evolve' || (address === '/api/export' && /"what": *"result"/.test(String(body)));
}

export class PairOfPrograms implements Program {
  private readonly cells: ProgramInPage;
  private readonly recordings: ProgramInPage;

  constructor(parts: Parts, listener: Listener) {
    this.recordings = new ProgramInPage(parts, listener);
    this.cells = new ProgramInPage({ ...parts, tables: [] }, listener); // what is solved needs none
  }

  answer(path: string, options: RequestInit): Promise<Response> {
    return (isSolved(path, options) ? this.cells : this.recordings).answer(path, options);
  }

  picture(path: string): Promise<string> {
    return this.recordings.picture(path);
  }

  open(files: File[]): Promise<string[]> {
    return this.recordings.open(files);
  }
}
