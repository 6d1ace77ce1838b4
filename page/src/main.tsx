import { render } from 'preact';
import { App } from './shell/App';
import { startPlace } from './shell/place';
import { startSession } from './shell/session';
import { startAtItems } from './shell/start';
import { startTheme } from './shell/theme';
import './look/tokens.css';
import './look/page.css';

startTheme();
startPlace();
await startAtItems(await startSession());
render(<App />, document.getElementById('page')!);
