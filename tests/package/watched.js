import './watched-worker.js';
import './dist/worker.js';
