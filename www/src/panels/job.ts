import { byId } from '../dom.ts';
import type { Jobs } from '../jobs.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** Progress of the long job at work. */
export function showJob(store: Store<State>): void {
  const bar = byId<HTMLProgressElement>('job-progress');
  store.on(['job', 'model'], ({ job, model }) => {
    byId('empty').hidden = model !== undefined || job !== undefined;
  });
  store.on(['job'], ({ job }) => {
    byId('job').hidden = !job;
    document.body.setAttribute('aria-busy', String(job !== undefined));
    if (!job) return;
    byId<HTMLButtonElement>('job-cancel').disabled = !job.canCancel;
    setText('job-label', job.label);
    byId('job-stage').textContent = job.fraction === undefined ? job.stage : `${job.stage} ${Math.floor(100 * job.fraction)} %`;
    if (job.fraction === undefined) bar.removeAttribute('value');
    else bar.value = job.fraction;
  });
}

/** Leaves the same text alone, so that it is not announced again. */
function setText(id: string, text: string): void {
  if (byId(id).textContent !== text) byId(id).textContent = text;
}

/** The cancel button, and Escape, which also puts a message away. */
export function jobControls(store: Store<State>, jobs: Jobs): void {
  byId('job-cancel').addEventListener('click', () => jobs.cancel());
  addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    if (jobs.isRunning) jobs.cancel();
    else store.set({ problem: undefined });
  });
}
