import './style/index.css';
import { followAddress } from './actions/address.ts';
import { followModel } from './actions/check.ts';
import { followFiles } from './actions/keep-file.ts';
import { followMade } from './actions/keep-made.ts';
import { followPlane } from './actions/layer.ts';
import { followRecipe } from './actions/print.ts';
import { followResults } from './actions/results.ts';
import { addressOf } from './address.ts';
import { byId } from './dom.ts';
import { startOffline } from './offline.ts';
import { startPage } from './page.ts';
import { checkPanel } from './panels/check.ts';
import { combinePanel } from './panels/combine.ts';
import { defectStepper } from './panels/defects.ts';
import { distanceLegend } from './panels/distance-legend.ts';
import { dock } from './panels/dock.ts';
import { enginePanel, fieldButton } from './panels/engine.ts';
import { folds, showTool } from './panels/folds.ts';
import { halvesButton } from './panels/halves.ts';
import { jobControls, showJob } from './panels/job.ts';
import { layerPanel } from './panels/layer.ts';
import { legendPanel } from './panels/legend.ts';
import { modelControls, showModelFacts } from './panels/model.ts';
import { movesPanel } from './panels/moves.ts';
import { withoutView } from './panels/no-view.ts';
import { notes } from './panels/note.ts';
import { offsetPanel } from './panels/offset.ts';
import { followOptions } from './panels/options.ts';
import { planPanel } from './panels/plan.ts';
import { measureLegend, pointControls } from './panels/points.ts';
import { printPanel } from './panels/print.ts';
import { problemPanel } from './panels/problem.ts';
import { repairPanel } from './panels/repair.ts';
import { resultsPanel } from './panels/results.ts';
import { showPanel } from './panels/show.ts';
import { surfacePanel, voxelPanel } from './panels/solid.ts';
import { texturePanel } from './panels/texture.ts';
import { problemOf } from './problem.ts';
import { initialState } from './state.ts';
import type { State } from './state.ts';
import { Store } from './store.ts';
import { startTheme } from './theme.ts';
import type { View } from './view/view.ts';

/** The longest that anything waits for the page to be seen. */
const PATIENCE_MILLISECONDS = 300;

let view: View | undefined;
startTheme(byId<HTMLButtonElement>('theme'), () => view?.refresh());
await painted();
let shown = (): void => undefined;
void startOffline(new Promise<void>((resolve) => (shown = resolve)));
const store = new Store<State>(initialState());
folds(store);
showJob(store);
problemPanel(store);
enginePanel(store);
showModelFacts(store);
showPanel(store);
legendPanel(store);
distanceLegend(store);
measureLegend(store);
halvesButton(store);
movesPanel(store);
dock(store);
planPanel(store);
notes(store);
void startView();
await startEngine();
shown();

/** Resolves when the page is seen as it comes, before anything that keeps the graphics card busy; a page out of sight does not wait for that. */
function painted(): Promise<void> {
  return new Promise((resolve) => {
    new PerformanceObserver(() => resolve()).observe({ type: 'paint', buffered: true });
    setTimeout(resolve, PATIENCE_MILLISECONDS);
  });
}

/** Without WebGL 2 the rest of the page still works. */
async function startView(): Promise<void> {
  try {
    const { View } = await import('./view/view.ts');
    view = new View(store);
  } catch (error) {
    withoutView(error);
  }
}

async function startEngine(): Promise<void> {
  store.set({ job: { label: 'Starting', stage: 'loading the engine', canCancel: false } });
  try {
    const page = await startPage(store);
    modelControls(page);
    pointControls(page);
    layerPanel(page);
    checkPanel(page);
    repairPanel(page);
    voxelPanel(page);
    surfacePanel(page);
    offsetPanel(page);
    combinePanel(page);
    texturePanel(page);
    defectStepper(store);
    printPanel(page);
    fieldButton(page);
    jobControls(store, page.jobs);
    followPlane(page);
    followModel(page);
    resultsPanel(page);
    followFiles(page);
    followResults(page);
    followMade(page);
    const restore = followOptions(() => addressOf(location.hash));
    await Promise.all([followAddress(page, showTool).then(restore), followRecipe(page)]);
  } catch (error) {
    byId('engine').dataset.state = 'failed';
    byId('engine-text').textContent = 'not running';
    store.set({ job: undefined, problem: problemOf('The engine could not start', error) });
  }
}
