// The only script of the page that is not packed: it unpacks the others, or says why that is not possible.
import { cannotRun } from './needed';
import { unpackedText } from './unpacked';

async function start(): Promise<void> {
  const script = document.createElement('script');
  script.type = 'module';
  script.textContent = await unpackedText(document.getElementById('page-script')!.textContent!);
  document.body.append(script);
}

start().catch((failure) => {
  document.getElementById('starting')!.textContent = cannotRun(failure instanceof Error ? failure.message : String(failure));
});
